// Sums over the triangles of a scene, by all threads, the same to the bit for any number of them.
#pragma once

#include <array>

#include "core/base/parallel_chunks.h"
#include "core/scene/description.h"

namespace pl {

/// Calls add(sums, corners) for all triangles; returns the sums of parts of the scene, each begun with `empty`.
template <class Sums, class Add>
std::vector<Sums> sums_of_triangles(const SceneDescription& scene, const Sums& empty, Add&& add) {
    return sums_of_chunks(
        scene.triangles.size(), kElementChunk, usable_threads(), empty, [&](Sums& sums, IndexRange range) {
            for (std::uint32_t i = range.begin; i < range.end; ++i) {
                const glm::uvec3& vertex = scene.triangles[i].vertex;
                add(sums, std::array{glm::dvec3(scene.positions[vertex.x]), glm::dvec3(scene.positions[vertex.y]),
                                     glm::dvec3(scene.positions[vertex.z])});
            }
        });
}

}  // namespace pl
