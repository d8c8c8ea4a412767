// The layout of a learned field in files: in those of fields, and in checkpoints.
#pragma once

#include <fmt/ranges.h>

#include "core/fields/field_choices.h"
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

/// Choices as files store them: "0 (table), 1 (sd-tree)".
template <Described Enum>
std::string choice_numbers() {
    std::vector<std::string> numbers;
    for (const ChoiceInfo<Enum>& info : kChoices<Enum>)
        numbers.push_back(fmt::format("{} ({})", static_cast<std::uint32_t>(info.value), info.name));
    return fmt::format("{}", fmt::join(numbers, ", "));
}

/// Throws Error(Input) unless a number that was read from `what`, a file at `path`, is that of a representation.
inline void require_representation(Representation representation, const std::filesystem::path& path,
                                   std::string_view what) {
    constexpr auto kPriorOfTables = static_cast<Representation>(3);
    if (representation == kPriorOfTables)
        throw Error(
            ErrorKind::Input,
            fmt::format("{}: {} of a representation that is no longer there: expected one of {}, got tables with a "
                        "network as their prior",
                        path.string(), what, fmt::join(choice_names<Representation>(), ", ")));
    if (!is_choice(representation))
        fail_damaged(path, what,
                     fmt::format("representation: expected one of {}, got {}", choice_numbers<Representation>(),
                                 static_cast<std::uint32_t>(representation)));
}

/// The arrays, behind their representation.
template <class Stream, class Field>
void transfer_tables(Stream& stream, Field& field) {
    Representation representation = representation_of(field);
    transfer(stream, representation);
    if constexpr (!std::is_const_v<Field>) {
        require_representation(representation, stream.path(), stream.what());
        clear_to(field, representation);
    }
    std::visit(
        [&](auto& arrays) { zip(arrays, arrays, [&](const auto&, auto& array) { transfer_array(stream, array); }); },
        field);
}

}  // namespace pl
