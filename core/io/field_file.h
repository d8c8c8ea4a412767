// Files of learned fields: their layout, the checks of what was read, reading and writing.
#pragma once

#include <filesystem>

#include <fmt/ranges.h>

#include "core/fields/field_choices.h"
#include "core/fields/field_model.h"
#include "core/fields/refine_placement.h"
#include "core/io/sealed_file.h"
#include "core/session/learned_field.h"

namespace pl {

// The layout of a learned field in field files and in checkpoints.

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

/// Throws Error(Input) unless a number that was read from `what`, a file at `path`, is the number of a
/// representation.
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

// Validation of learned fields from files, before kernels use their values as indices and probabilities.

/// Throws Error(Input) with file, array, expected and actual value. `path` is for the message only.
void require_usable(const LearnedField& field, const std::filesystem::path& path);

// Learned fields in files, to resume learning later or elsewhere. Binary, little endian, versioned, with a checksum.
// The bits are exact, so resuming from a file equals an uninterrupted run.
//   "PLFIELD\n" | u32 version | u64 bytes of the file | settings, shape, progress | arrays, each behind its count |
//   u64 Fnv1a of all preceding bytes

/// Writes atomically (write_file_atomic). Throws Error(Runtime) if the file cannot be written.
void write_field(const std::filesystem::path& path, const LearnedField& field);

/// Throws Error(Input) with the path for a file that is missing, of another kind or version, truncated, corrupt, or
/// with invalid values (require_usable). The session checks whether the field belongs to its scene.
LearnedField read_field(const std::filesystem::path& path);

}  // namespace pl
