// The layout of a learned field in files: in those of fields, and in checkpoints.
#pragma once

#include "core/fields/field_model.h"
#include "core/fields/refine_placement.h"
#include "core/io/binary_stream.h"

namespace pl {

template <class Stream, class Settings>
void transfer_settings(Stream& stream, Settings& settings) {
    const auto all = [&](auto&... values) { (transfer(stream, values), ...); };
    all(settings.volumes, settings.budget_megabytes, settings.bins, settings.rate, settings.learning.target,
        settings.learning.light, settings.uniform_floor, settings.precompute_samples, settings.refine_share,
        settings.representation);
}

template <class Stream, class Shape>
void transfer_shape(Stream& stream, Shape& shape) {
    const auto all = [&](auto&... values) { (transfer(stream, values), ...); };
    all(shape.cells.side, shape.light_clusters, shape.radiance_unit, shape.extent, shape.rate, shape.uniform_floor,
        shape.representation, shape.corner, shape.edge, shape.most_nodes);
}

template <class Stream, class Rounds>
void transfer_refinement(Stream& stream, Rounds& refinement) {
    transfer(stream, refinement.rounds);
    transfer(stream, refinement.added);
}

/// Sites, normals and tree: the grid follows from them and the scene.
template <class Stream, class Volumes>
void transfer_volumes(Stream& stream, Volumes& volumes) {
    zip_placement(volumes, volumes, [&](const auto&, auto& array) { transfer_array(stream, array); });
}

/// The arrays, behind their representation.
template <class Stream, class Field>
void transfer_tables(Stream& stream, Field& field) {
    Representation representation = representation_of(field);
    transfer(stream, representation);
    if constexpr (!std::is_const_v<Field>) {
        if (representation > kLastRepresentation)
            stream.fail(fmt::format("representation: expected 0 to {}, got {}",
                                    static_cast<std::uint32_t>(kLastRepresentation),
                                    static_cast<std::uint32_t>(representation)));
        clear_to(field, representation);
    }
    std::visit(
        [&](auto& arrays) { zip(arrays, arrays, [&](const auto&, auto& array) { transfer_array(stream, array); }); },
        field);
}

}  // namespace pl
