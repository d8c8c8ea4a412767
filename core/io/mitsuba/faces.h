// Meshes that the reader of Mitsuba's shapes makes face by face.
#pragma once

#include <cstdint>
#include <initializer_list>

#include "core/io/obj_mesh.h"

namespace pl {

/// One part, of one material and group.
inline ObjMesh empty_mesh() {
    ObjMesh mesh;
    mesh.parts.emplace_back();
    mesh.parts.front().runs.emplace_back();
    mesh.groups.emplace_back();
    return mesh;
}

/// Corners of all faces of a mesh by arrays of their own, as the reader of OBJ files gives them.
inline void add_face(ObjMesh& mesh, std::initializer_list<ObjCorner> corners) {
    ObjFaces& faces = mesh.parts.front();
    faces.corners.insert(faces.corners.end(), corners);
    faces.corner_counts.push_back(static_cast<std::uint32_t>(corners.size()));
    faces.lines.push_back(1);
}

}  // namespace pl
