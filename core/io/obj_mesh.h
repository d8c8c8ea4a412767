// The elements of an OBJ file with all indices resolved, and their reader.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "core/base/choice.h"

namespace pl {

/// Indices from 0 into the arrays of an ObjMesh; kNone: not given.
struct ObjCorner {
    static constexpr std::uint32_t kNone = 0xffffffffu;

    std::uint32_t vertex = 0;
    std::uint32_t normal = kNone;
    std::uint32_t uv = kNone;
};

/// By the last `s` statement.
enum class Smoothing : std::uint8_t {
    Off,
    On,
    Inherited  ///< from the part of the text before
};

/// Consecutive faces of a file.
struct ObjFaces {
    /// Faces from `first` on, up to the next run, with one material, group and smoothing.
    struct Run {
        std::size_t first = 0;
        std::uint32_t material = kNoMaterial;
        std::uint32_t group = 0;
        Smoothing smoothing = Smoothing::Off;
    };
    static constexpr std::uint32_t kNoMaterial = 0xffffffffu;

    std::vector<ObjCorner> corners;            ///< of all faces, one after the other
    std::vector<std::uint32_t> corner_counts;  ///< per face
    std::vector<int> lines;                    ///< per face: its line in the file
    std::vector<Run> runs;                     ///< of all faces; some may have none

    std::size_t size() const { return corner_counts.size(); }
    /// Faces of a run.
    std::size_t end_of(std::size_t run) const { return run + 1 < runs.size() ? runs[run + 1].first : size(); }
    /// Triangles if every face is cut without loss.
    std::size_t triangles() const { return corners.size() - 2 * size(); }
};

/// A name as written, and the line of its first use.
struct ObjName {
    std::string name;
    int line = 0;
};

/// The treatment of the lengths of normals.
enum class ObjNormals : std::uint8_t {
    Any,   ///< all are made unit
    Unit,  ///< those that are unit to within rounding keep their bits, which dividing by the length would change
};

template <>
inline constexpr auto kChoices<ObjNormals> = std::to_array<ChoiceInfo<ObjNormals>>({
    {ObjNormals::Any, "any", "Any"},
    {ObjNormals::Unit, "unit", "Unit"},
});

struct ObjMesh {
    glm::dvec3 origin{0.0};            ///< of the positions, in coordinates of the file
    std::vector<glm::vec3> positions;  ///< from `origin`, taken off in doubles
    std::vector<glm::vec3> normals;    ///< of any length
    ObjNormals lengths = ObjNormals::Any;
    std::vector<glm::vec2> uvs;
    std::vector<ObjFaces> parts;        ///< in the order of the file
    std::vector<ObjName> materials;     ///< of `usemtl`
    std::vector<std::string> groups;    ///< arguments of `o` and `g` statements; the first is empty: faces before any
    std::vector<ObjName> libraries;     ///< arguments of each `mtllib`
    std::vector<std::string> warnings;  ///< about statements that were left out
};

/// Bytes of text that a thread reads at once.
inline constexpr std::size_t kObjChunk = std::size_t{1} << 20;

/// Reads an OBJ text in chunks, twice: elements first, because a face may name a later one. The result does not depend on `threads` and
/// `chunk_bytes`. Negative indices count back from the face. Elements without usable numbers are zeros. Faces with a vertex of this kind,
/// or one that is not there, are left out; so are the normals and texture points of a face if one of them is of this kind; each kind of
/// fault with one counted warning. Throws Error(Input) for a control character, with its line, for too many elements, and if there is no
/// usable face. `origin`: of the mesh.
ObjMesh read_obj_text(std::string_view text, const std::filesystem::path& path, int threads,
                      const glm::dvec3& origin = glm::dvec3(0.0), std::size_t chunk_bytes = kObjChunk);

}  // namespace pl
