// Spheres and disks as meshes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "core/io/mitsuba/xml_file.h"
#include "core/io/obj_mesh.h"

namespace pl {

// Meshes that the reader of Mitsuba's shapes makes face by face.

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

/// Numbers of spheres and disks in a file, which decide how fine they are.
struct RoundShapes {
    std::size_t emitting = 0;  ///< shapes of groups count for every instance, since they are copied
    std::size_t others = 0;    ///< shapes of groups count once

    /// Sides of the equators of spheres, and of disks: a silhouette of 256 sides is within 0.007 % of its radius, one of 64 within 0.1 %.
    /// Fewer for many shapes: up to a thousand together have at most 4 million triangles. Fewer for shapes that emit,
    /// since each triangle is a light to choose: a picture with 20 spheres of 64 sides or with 100 takes 1.6 times as
    /// long as with 32.
    std::uint32_t sides(bool emits) const;
};

RoundShapes count_round_shapes(const MitsubaFile& file);

/// The sphere of radius 1, with its own normals: sides / 2 rows of `sides` faces, and the area of the sphere.
ObjMesh sphere_mesh(std::uint32_t sides);

/// The disk of radius 1 that faces +z, with its area. Texture coordinates: the distance from the middle, and the share of a turn from x.
ObjMesh disk_mesh(std::uint32_t sides);

}  // namespace pl
