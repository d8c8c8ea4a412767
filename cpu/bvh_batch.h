// The scene's BVH as a batch intersector: traverses it ray by ray.
#pragma once

#include "core/kernel/geometry/intersector.h"
#include "cpu/ray_batch.h"

namespace pl {

/// Satisfies BatchIntersector.
class BvhBatch {
public:
    explicit BvhBatch(const SceneView& scene) : intersector_{scene} {}

    void find_closest(RayBatch& batch, std::uint32_t count) const {
        for (std::uint32_t i = 0; i < count; ++i) batch.set_hit(i, intersector_.closest_hit(batch.ray(i)));
    }
    void find_occluded(RayBatch& batch, std::uint32_t count) const {
        for (std::uint32_t i = 0; i < count; ++i) batch.set_occluded(i, intersector_.occluded(batch.ray(i)));
    }

    /// See BatchTracer.
    void move_to(const SceneView& scene) { intersector_ = BvhIntersector{scene}; }

private:
    BvhIntersector intersector_;
};
static_assert(BatchIntersector<BvhBatch>);

}  // namespace pl
