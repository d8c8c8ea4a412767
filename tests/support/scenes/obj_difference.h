// Comparison of the meshes that two readings make of an OBJ text.
#pragma once

#include <cstring>
#include <string>
#include <tuple>
#include <vector>

#include "core/io/obj_mesh.h"

namespace pl::test {

/// The faces of all parts as one, however they are divided into parts and runs.
struct FlatFaces {
    std::vector<ObjCorner> corners;
    std::vector<std::uint32_t> corner_counts;
    std::vector<std::tuple<int, std::uint32_t, std::uint32_t, Smoothing>> looks;  ///< line, material, group

    explicit FlatFaces(const ObjMesh& mesh) {
        for (const ObjFaces& part : mesh.parts) {
            corners.insert(corners.end(), part.corners.begin(), part.corners.end());
            corner_counts.insert(corner_counts.end(), part.corner_counts.begin(), part.corner_counts.end());
            for (std::size_t run = 0; run < part.runs.size(); ++run)
                for (std::size_t face = part.runs[run].first; face < part.end_of(run); ++face)
                    looks.emplace_back(part.lines[face], part.runs[run].material, part.runs[run].group,
                                       part.runs[run].smoothing);
        }
    }
};

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

inline bool same_names(const std::vector<ObjName>& a, const std::vector<ObjName>& b) {
    bool same = a.size() == b.size();
    for (std::size_t i = 0; same && i < a.size(); ++i) same = a[i].name == b[i].name && a[i].line == b[i].line;
    return same;
}

/// The first difference between two readings, in bits and order; nothing if they are the same.
inline std::string obj_difference(const ObjMesh& a, const ObjMesh& b) {
    const FlatFaces faces(a);
    const FlatFaces others(b);
    if (!same_bytes(a.positions, b.positions)) return "positions";
    if (!same_bytes(a.normals, b.normals)) return "normals";
    if (!same_bytes(a.uvs, b.uvs)) return "texture points";
    if (!same_bytes(faces.corners, others.corners)) return "corners";
    if (faces.corner_counts != others.corner_counts) return "numbers of corners";
    if (faces.looks != others.looks) return "lines, materials, groups or smoothing of faces";
    if (faces.looks.size() != faces.corner_counts.size()) return "faces outside of runs";
    if (!same_names(a.materials, b.materials)) return "materials";
    if (a.groups != b.groups) return "groups";
    if (!same_names(a.libraries, b.libraries)) return "material libraries";
    if (a.warnings != b.warnings) return "warnings";
    return {};
}

}  // namespace pl::test
