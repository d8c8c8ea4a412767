// Scenes of few triangles: all leaves of the hierarchy, one after the other, for all rays of a warp alike.
#pragma once

#include "core/kernel/geometry/bvh_view.h"

namespace pl {

/// Leaves whose boxes are tested before the triangles of any of them.
inline constexpr std::uint32_t kSmallGroup = 32;

/// Leaves and triangles of a hierarchy with at most kMostSmallTriangles triangles, in the fastest memory that a back end has for them.
struct SmallScene {
    const BvhNode* root;
    const BvhNode* leaves;
    const BvhTriangle* triangles;
    std::uint32_t leaf_count;
};

/// Visits the triangles of all leaves that the ray may enter, as traverse() does, in the order of the leaves. First the boxes of
/// up to 32 leaves, which all lanes of a warp read at once, then those that the ray enters: the former takes the same time for all
/// rays, the latter is short.
template <class Visit>
PL_HD inline void traverse(const SmallScene& scene, const Ray& ray, Hit& best, Visit&& visit) {
    if (!can_hit(ray)) return;
    const BoxRay box_ray = make_box_ray(*scene.root, ray);
    for (std::uint32_t first = 0; first < scene.leaf_count; first += kSmallGroup) {
        const std::uint32_t count = min_of(scene.leaf_count - first, kSmallGroup);
        std::uint32_t entered = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const BvhNode leaf = scene.leaves[first + i];
            entered |= (intersect_box(leaf, box_ray, best.t) < kInfinity ? 1u : 0u) << i;
        }
        for (; entered != 0; entered &= entered - 1)
            if (visit_leaf(scene.triangles, scene.leaves[first + lowest_bit(entered)].reference(), best, visit))
                return;
    }
}

}  // namespace pl
