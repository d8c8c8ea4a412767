// Sums over the triangles of a scene, by all threads, the same to the bit for any number of them.
#pragma once

#include <array>

#include "core/base/parallel_chunks.h"
#include "core/scene/description.h"
#include "core/scene/instance_boxes.h"
#include "core/scene/instances.h"

namespace pl {

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

}  // namespace pl
