// Boxes around instances, by which searches over the surfaces of a scene see them without a look at their triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "core/scene/bounds.h"
#include "core/scene/description.h"

namespace pl {

/// The box of each mesh of a scene, in its space.
inline std::vector<Bounds> mesh_boxes(const SceneDescription& scene) {
    std::vector<Bounds> boxes(scene.meshes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const MeshDescription& mesh = scene.meshes[i];
        for (std::uint32_t t = mesh.first_triangle; t < mesh.first_triangle + mesh.triangle_count; ++t)
            for (int k = 0; k < 3; ++k) boxes[i].add(scene.positions[scene.triangles[t].vertex[k]]);
    }
    return boxes;
}

/// The corners of a mesh's box in the world, high in x, y and z by the bits 0, 1 and 2 of their number.
inline std::array<glm::dvec3, 8> box_corners(const Bounds& box, const glm::mat4x3& to_world) {
    const glm::dmat4x3 m(to_world);
    std::array<glm::dvec3, 8> corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
        corners[i] = m * glm::dvec4((i & 1) != 0 ? box.high.x : box.low.x, (i & 2) != 0 ? box.high.y : box.low.y,
                                    (i & 4) != 0 ? box.high.z : box.low.z, 1.0);
    return corners;
}

/// Calls fn(corners) for the twelve triangles of a box, fronts outwards.
template <class Fn>
void for_box_triangles(const std::array<glm::dvec3, 8>& corners, Fn&& fn) {
    constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (const auto& face : kFaces) {
        fn(std::array{corners[face[0]], corners[face[1]], corners[face[2]]});
        fn(std::array{corners[face[0]], corners[face[2]], corners[face[3]]});
    }
}

}  // namespace pl
