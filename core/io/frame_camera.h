// The camera that frames a scene which brings none, and the side that a room is open to.
#pragma once

#include <array>
#include <optional>

#include <glm/glm.hpp>

#include "core/base/parallel.h"
#include "core/scene/description.h"
#include "core/scene/instance_boxes.h"
#include "core/scene/instances.h"

namespace pl {

// Sums over the triangles of a scene, by all threads, the same to the bit for any number of them.

/// Calls add(sums, corners) for all direct triangles, and for the triangles of a box around each instance; returns the sums of parts of the
/// scene, each begun with `empty`.
template <class Sums, class Add>
std::vector<Sums> sums_of_triangles(const SceneDescription& scene, const Sums& empty, Add&& add) {
    const auto add_direct = [&](Sums& sums, IndexRange range) {
        for (std::uint32_t i = range.begin; i < range.end; ++i) {
            const glm::uvec3& vertex = scene.triangles[i].vertex;
            add(sums, std::array{glm::dvec3(scene.positions[vertex.x]), glm::dvec3(scene.positions[vertex.y]),
                                 glm::dvec3(scene.positions[vertex.z])});
        }
    };
    const std::vector<Bounds> boxes = mesh_boxes(scene);
    const auto add_boxes = [&](Sums& sums, IndexRange range) {
        for (std::uint32_t i = range.begin; i < range.end; ++i) {
            const InstanceDescription& instance = scene.instances[i];
            for_box_triangles(box_corners(boxes[instance.mesh], instance.to_world),
                              [&](const std::array<glm::dvec3, 3>& corners) { add(sums, corners); });
        }
    };
    std::vector<Sums> sums =
        sums_of_chunks(direct_triangles(scene), kElementChunk, usable_threads(), empty, add_direct);
    const std::vector<Sums> more =
        sums_of_chunks(scene.instances.size(), kElementChunk, usable_threads(), empty, add_boxes);
    sums.insert(sums.end(), more.begin(), more.end());
    return sums;
}

// Boxes that are open on one side, as rooms are that were modelled to be looked into.

/// The side of the scene's bounds through which one looks deep into them: of kOpenSideGrid^2 parallel rays nine tenths meet
/// a surface, on average more than half the extent behind the side. A horizontal axis with its sign, pointing
/// out of the scene; the deepest one, and of equal ones the first of front_of(scene.up), its opposite, right and left.
/// Instances count as boxes around them. Empty if there is none, as for everything that is flat in the direction of the rays.
std::optional<glm::vec3> open_side(const SceneDescription& scene);

inline constexpr int kOpenSideGrid = 32;

// Default camera of scenes without one.

/// Looks at the center of the scene's bounds, level by scene.up, from where a square picture with angle `fov_deg` just
/// holds the scene: no vertex is nearer to an edge than a twentieth of the side. The side that it looks from:
/// - A box that is open on one of its four sides is seen through the opening, straight on, see open_side().
/// - Everything else is seen in three-quarter view: from the front, front_of(), turned by 35 degrees to the right,
///   or from behind or from the left if more front-facing area is visible there. From 20 degrees above the horizon, or
///   40 if the scene is flat.
/// Instances count as boxes around them. The scene must have a triangle.
CameraDescription frame_camera(const SceneDescription& scene, float fov_deg = 40.0f);

}  // namespace pl
