// Scenes of few triangles: all leaves of the hierarchy, one after the other, for all rays of a warp alike.
#pragma once

#include "core/kernel/geometry/bvh_view.h"

namespace pl {

/// Leaves and triangles of a hierarchy with at most kMostSmallTriangles triangles, in the fastest memory that a back end has for them.
struct SmallScene {
    const BvhNode* root;
    const SmallLeaf* leaves;
    const BvhTriangle* triangles;
    std::uint32_t leaf_count;
};

/// Triangles of a small scene as a set of bits.
class SmallTriangles {
public:
    PL_HD bool empty() const { return (first_ | last_) == 0; }
    PL_HD void add(const SmallLeaf& leaf) {
        first_ |= leaf.first_triangles;
        last_ |= leaf.last_triangles;
    }
    /// Removes the triangle with the lowest number, which is returned. There must be one.
    PL_HD std::uint32_t take() {
        if (first_ != 0) return take_bit(first_);
        return 32u + take_bit(last_);
    }

private:
    static PL_HD std::uint32_t take_bit(std::uint32_t& bits) {
        const std::uint32_t lowest = lowest_bit(bits);
        bits &= bits - 1;
        return lowest;
    }

    std::uint32_t first_ = 0;
    std::uint32_t last_ = 0;
};

/// The triangles of all leaves that a ray which can_hit() may enter.
PL_HD inline SmallTriangles entered_triangles(const SmallScene& scene, const Ray& ray, float t_max) {
    const BoxRay box_ray = make_box_ray(*scene.root, ray);
    SmallTriangles entered;
    for (std::uint32_t i = 0; i < scene.leaf_count; ++i) {
        const SmallLeaf leaf = scene.leaves[i];
        if (intersect_box(leaf, box_ray, t_max) < kInfinity) entered.add(leaf);
    }
    return entered;
}

/// Visits the triangles of all leaves that the ray may enter, as traverse() of a BvhView does, in their order. First the boxes of
/// all leaves, which takes the same time for all rays; then the triangles, one in each turn of a single loop: the lanes of a warp
/// wait for the one with the most triangles, not for the largest leaf in each turn.
template <class Visit>
PL_HD inline void traverse(const SmallScene& scene, const Ray& ray, Hit& best, Visit&& visit) {
    if (!can_hit(ray)) return;
    SmallTriangles entered = entered_triangles(scene, ray, best.t);
    while (!entered.empty()) {
        const BvhTriangle triangle = scene.triangles[entered.take()];
        if (visit(triangle, best)) return;
    }
}

}  // namespace pl
