#include "cpu/rays/wide_intersector.h"

namespace pl {
void WideIntersector::find_closest(RayBatch& batch, std::uint32_t count) const {
    if (!nodes_.empty()) return kernels_.find_closest_wide(view(), batch.ray_groups(), batch.hit_groups(), count);
    for (std::uint32_t i = 0; i < count; ++i) batch.set_hit(i, {.t = batch.ray(i).t_max});
}

void WideIntersector::find_occluded(RayBatch& batch, std::uint32_t count) const {
    if (!nodes_.empty())
        return kernels_.find_occluded_wide(view(), batch.ray_groups(), batch.occlusion_masks(), count);
    for (std::uint32_t i = 0; i < count; ++i) batch.set_occluded(i, false);
}

WideView WideIntersector::view() const {
    return {.root = bvh_.nodes[0],
            .nodes = nodes_.data(),
            .triangles = bvh_.triangles.data,
            .blocks = exceeds_caches_ ? nullptr : blocks_.data()};
}

}  // namespace pl
