// First reading of a part of an OBJ text: vertices, normals and texture points.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "core/io/tally.h"

namespace pl {

/// The lists whose elements the corners of faces name.
enum ObjList : std::size_t { kObjVertices, kObjNormals, kObjUvs, kObjLists };
inline constexpr std::array<const char*, kObjLists> kObjElementNames = {"vertex", "normal", "texture point"};

/// The list that a statement adds to, or kObjLists.
inline ObjList obj_list_of(std::string_view keyword) {
    if (keyword == "v") return kObjVertices;
    if (keyword == "vn") return kObjNormals;
    return keyword == "vt" ? kObjUvs : kObjLists;
}

/// Numbers of elements, other statements, the faces among these, and lines.
struct ObjCounts {
    std::array<std::size_t, kObjLists> elements{};
    std::size_t others = 0;
    std::size_t faces = 0;
    std::size_t lines = 0;
};

/// What `v`, `vn` and `vt` statements say.
struct ObjElements {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs;
    /// Ascending indices, from 0, of the elements of each list that have no usable numbers; these are zeros.
    std::array<std::vector<std::size_t>, kObjLists> unusable;
    ObjCounts counts;  ///< of the text, with lines of any kind
    std::array<Tally, kObjLists> malformed;
    Tally colors;   ///< vertices with more than four numbers
    Tally weights;  ///< vertices with four numbers

    bool are_all_usable() const { return unusable[0].empty() && unusable[1].empty() && unusable[2].empty(); }
    bool is_usable(std::size_t list, std::size_t index) const;
    /// Adds the elements of the part of the text that follows.
    void append(ObjElements&& later);
};

/// The elements of a text that begins with a line and ends with a statement; lines count from 1. Positions are relative to `origin`, taken
/// off in doubles.
ObjElements read_obj_elements(std::string_view text, const glm::dvec3& origin);

}  // namespace pl
