// Instances: meshes that a scene shows any number of times, each time transformed. Their triangles are stored once; rays meet
// primitives, which number the triangles of every instance. A scene with copies in the place of instances has the same primitives with
// the same corners, bit by bit.
#pragma once

#include "core/kernel/base/span.h"
#include "core/kernel/geometry/bvh_view.h"

namespace pl {

/// One coordinate of the image of a point, or of as many as Real has lanes.
template <class Real>
PL_INLINE Real affine_coordinate(const Vec4f& row, const Real& x, const Real& y, const Real& z) {
    return row.x * x + row.y * y + row.z * z + row.w;
}

/// An affine map: coordinate i of the image of p is the sum of the products of p with x, y, z of row i, and w, rounded in this order.
struct Affine {
    Vec4f rows[3];

    PL_INLINE Vec3f point(Vec3f p) const {
        return {affine_coordinate(rows[0], p.x, p.y, p.z), affine_coordinate(rows[1], p.x, p.y, p.z),
                affine_coordinate(rows[2], p.x, p.y, p.z)};
    }
    PL_INLINE Vec3f vector(Vec3f v) const {
        return {rows[0].x * v.x + rows[0].y * v.y + rows[0].z * v.z,
                rows[1].x * v.x + rows[1].y * v.y + rows[1].z * v.z,
                rows[2].x * v.x + rows[2].y * v.y + rows[2].z * v.z};
    }
    /// The transposed map of vectors: the transposed inverse maps normals.
    PL_HD Vec3f transposed(Vec3f n) const {
        return {rows[0].x * n.x + rows[1].x * n.y + rows[2].x * n.z,
                rows[0].y * n.x + rows[1].y * n.y + rows[2].y * n.z,
                rows[0].z * n.x + rows[1].z * n.y + rows[2].z * n.z};
    }
};

/// A mesh in the scene.
struct alignas(16) Instance {
    Affine to_world;
    Affine to_mesh;                     ///< the inverse, rounded
    std::uint32_t first_primitive = 0;  ///< its primitives follow each other in the order of the mesh's triangles
    std::uint32_t first_triangle = 0;   ///< of the mesh, in SceneView::triangles
    std::uint32_t root = 0;             ///< node of InstancesView::mesh_nodes
    float error = 0.0f;  ///< bounds the distance, in the space of the mesh, of a ray's hit from the mesh: error +
    float error_per_distance =
        0.0f;  ///< error_per_distance x the largest component of the ray's origin; see pack_instances.cpp
    /// Complete 128 bytes, so that equal instances have equal bytes.
    std::uint32_t zero1 = 0, zero2 = 0, zero3 = 0;
};
static_assert(sizeof(Instance) == 128);

struct InstancesView {
    Span<const Instance> list;
    Span<const std::uint32_t> first_primitives;  ///< [instance], once more: they are searched
    Span<const BvhNode> nodes;                   ///< hierarchy over `order`, root first
    Span<const std::uint32_t> order;             ///< numbers of instances, in the order of the leaves
    Span<const BvhNode> mesh_nodes;          ///< the hierarchies of all meshes, in their spaces; see Instance::root
    Span<const BvhTriangle> mesh_triangles;  ///< in the order of their leaves; `primitive` counts from 0 in each mesh
    double longest_edge = 0.0;               ///< bound on the edges of all triangles of the scene

    PL_HD bool empty() const { return list.count == 0; }
    /// The instance of a primitive that is not in the scene directly.
    PL_HD const Instance& instance_of(std::uint32_t primitive) const {
        std::uint32_t first = 0;
        std::uint32_t end = list.count;
        while (end - first > 1) {
            const std::uint32_t middle = first + (end - first) / 2;
            (first_primitives[middle] <= primitive ? first : end) = middle;
        }
        return list[first];
    }
};

}  // namespace pl
