// Choices with which a scene is opened.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/choice.h"
#include "core/scene/description.h"
#include "core/scene/up_axis.h"

namespace pl {

/// Copies are faster to trace than instances; these are about half a gigabyte of them.
inline constexpr std::uint64_t kMostCopiedTriangles = 2'000'000;

/// Where a choice is empty, the scene file decides.
struct LoadSettings {
    ParameterTexts parameters{};        ///< of knobs of scene files, of $parameters of Mitsuba files
    std::string camera{};               ///< name or number, from 1, of a camera that the file lists; empty: the first
    std::filesystem::path materials{};  ///< file of read_material_file(); empty for none
    std::optional<bool>
        default_light{};              ///< light a scene that has no light; on unless the scene file says otherwise
    std::optional<UpAxis> up_axis{};  ///< of default camera and default light; guessed unless it does
    /// Of glTF and Mitsuba files. If the meshes that a file shows more than once have at most so many triangles with all their copies, they
    /// are copied; else they are kept once, see KeptMeshes.
    std::uint64_t most_copied_triangles = kMostCopiedTriangles;
};

// Notes about parts of a file that the program does not show, or shows otherwise.

/// Each kind is told once, with its first place and how often it occurs.
class SceneNotes {
public:
    /// `kind` is a sentence about the content.
    void add(const std::string& kind, const std::string& place);
    /// Appends "place: kind (3 in all)", in the order of first places.
    void tell(std::vector<std::string>& warnings) const;

private:
    struct Note {
        std::string kind;
        std::string first;
        std::size_t count = 0;
    };
    std::vector<Note> notes_;
};

/// The two readings of MTL materials with both a color and an image.
enum class MapKd { Multiplies, Replaces };

template <>
inline constexpr auto kChoices<MapKd> = std::to_array<ChoiceInfo<MapKd>>({
    {MapKd::Multiplies, "multiply", "Multiply", "map_Kd times Kd, by the text of the format"},
    {MapKd::Replaces, "replace", "Replace", "map_Kd alone, as Blender reads it"},
});

}  // namespace pl
