// Traversal of a hierarchy by the lanes of a warp, which wait for each other where they do different things: a lane that has found
// a leaf postpones it and goes on, so that all descend together, and all test triangles together. That lanes meet again after a
// loop is not left to the compiler, which lets them go apart: they vote on every turn of every loop.
// [Aila and Laine 2009, "Understanding the Efficiency of Ray Traversal on GPUs", speculative while-while]
#pragma once

#include "core/kernel/geometry/bvh_view.h"

namespace pl {

/// One lane's way through a hierarchy that is not empty, by a ray that can_hit(), in steps. Leaves are visited later than by
/// traverse(), after more nodes; the closest hit is the same, because it does not depend on the order of the tests.
class PostponedTraversal {
public:
    PL_HD PostponedTraversal(const BvhView& bvh, const Ray& ray, float t_max, NodeMemory& memory)
        : bvh_(bvh), box_ray_(make_box_ray(bvh.nodes[0], ray)), stack_(memory) {
        const BvhNode root = bvh.nodes[0];
        if (intersect_box(root, box_ray_, t_max) == kInfinity) return;
        next_ = root.reference();
        postpone();
    }

    PL_HD bool is_at_inner_node() const { return next_.count() == 0; }
    PL_HD bool has_leaf() const { return leaf_.bits != kNone; }
    PL_HD bool looks_for_leaf() const { return is_at_inner_node() && !has_leaf(); }
    PL_HD bool is_over() const { return !is_at_inner_node() && !has_leaf(); }

    /// Goes on from an inner node to the nearer of its children that the ray may enter before `t_max`, or to the last node that
    /// waits. The first leaf met is postponed.
    PL_HD void descend(float t_max) {
        const NodePair pair = intersect_children(bvh_.nodes.data, next_, box_ray_, t_max);
        if (pair.enters_both()) stack_.push(pair.far());
        next_ = pair.enters_any() ? pair.near() : pop();
        postpone();
    }
    /// The postponed leaf; the next one takes its place if it is the next node.
    PL_HD NodeReference take_leaf() {
        const NodeReference leaf = leaf_;
        leaf_.bits = kNone;
        postpone();
        return leaf;
    }

    /// Visits nothing more.
    PL_HD void stop() { next_.bits = leaf_.bits = kNone; }

private:
    /// Reference to no node: neither an inner node nor a leaf.
    static constexpr std::uint32_t kNone = 0xffffffffu;

    PL_HD NodeReference pop() { return stack_.is_empty() ? NodeReference{kNone} : stack_.pop(); }
    PL_HD void postpone() {
        if (is_at_inner_node() || has_leaf() || next_.bits == kNone) return;
        leaf_ = next_;
        next_ = pop();
    }

    const BvhView& bvh_;
    BoxRay box_ray_;
    NodeReference next_{kNone};
    NodeReference leaf_{kNone};
    NodeStack stack_;
};

/// A hierarchy whose traversal postpones leaves.
struct PostponingBvh {
    const BvhView& bvh;
};

/// traverse() with postponed leaves. A lane with a leaf descends further as long as another one looks for its first; then all test
/// the triangles of one leaf.
template <class Visit>
PL_HD inline void traverse(const PostponingBvh& scene, const Ray& ray, Hit& best, Visit&& visit) {
    const BvhView& bvh = scene.bvh;
    if (bvh.nodes.empty() || !can_hit(ray)) return;
    const LaneGroup lanes = LaneGroup::active();
    NodeMemory memory;
    PostponedTraversal way(bvh, ray, best.t, memory);
    while (lanes.any(!way.is_over())) {
        while (lanes.any(way.looks_for_leaf()))
            if (way.is_at_inner_node()) way.descend(best.t);
        const NodeReference leaf = way.has_leaf() ? way.take_leaf() : NodeReference{0};
        std::uint32_t count = leaf.count();
        for (std::uint32_t i = 0; lanes.any(i < count); ++i) {
            if (i >= count) continue;
            const BvhTriangle triangle = bvh.triangles[leaf.first() + i];
            if (!visit(triangle, best)) continue;
            way.stop();
            count = 0;
        }
    }
}

}  // namespace pl
