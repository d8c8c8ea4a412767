// The scene's two-wide hierarchy as a batch intersector: traverses it ray by ray. A peer of the intersectors of the back end.
#pragma once

#include "core/kernel/geometry/intersector.h"
#include "cpu/base/ray_batch.h"

namespace pl::test {

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

private:
    BvhIntersector intersector_;
};
static_assert(BatchIntersector<BvhBatch>);

}  // namespace pl::test
