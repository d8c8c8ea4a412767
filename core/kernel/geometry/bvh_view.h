// Bounding volume hierarchy as an array of 32-byte nodes, and its traversal.
#pragma once

#include "core/kernel/base/span.h"
#include "core/kernel/geometry/triangle.h"

namespace pl {

/// Most triangles of a leaf, and the bits that hold their number.
inline constexpr std::uint32_t kMaxLeafSize = 4;
inline constexpr std::uint32_t kLeafBits = 3;
static_assert(kMaxLeafSize < (1u << kLeafBits));

/// Most triangles of a hierarchy: the numbers of its nodes, up to twice as many, fit a NodeReference.
inline constexpr std::uint32_t kMaxBvhTriangles = 1u << (31 - kLeafBits);

/// Children or triangles of a node in one word: `first`, and `count` in the lower bits.
struct NodeReference {
    std::uint32_t bits;  ///< not initialized, since stacks of references would be, too

    PL_HD std::uint32_t first() const { return bits >> kLeafBits; }
    PL_HD std::uint32_t count() const { return bits & ((1u << kLeafBits) - 1u); }
};

/// Inner node: `count` is 0 and the children are nodes `first` and `first + 1`. Leaf: `count` entries of BvhView::triangles from
/// `first` on. Aligned, like BvhTriangle, so that a device reads 16 bytes at once; for that a node has to be copied whole.
struct alignas(16) BvhNode {
    Vec3f low{kInfinity};
    std::uint32_t first = 0;
    Vec3f high{-kInfinity};
    std::uint32_t count = 0;

    PL_HD NodeReference reference() const { return {(first << kLeafBits) | count}; }
};
static_assert(sizeof(BvhNode) == 32);

/// A triangle of a leaf with its corners, so that they are found without its entry in SceneView::triangles.
struct alignas(16) BvhTriangle {
    Vec3f p0{0.0f};
    std::uint32_t primitive = kNoPrimitive;
    Vec3f p1{0.0f};
    std::uint32_t zero1 = 0;  ///< completes 16 bytes, so that equal triangles have equal bytes
    Vec3f p2{0.0f};
    std::uint32_t zero2 = 0;
};
static_assert(sizeof(BvhTriangle) == 48);

/// build_bvh() keeps the depth below this bound, so the traversal stack cannot overflow.
inline constexpr int kMaxBvhDepth = 64;

/// Most triangles of a scene for which BvhView::leaves is there.
inline constexpr std::uint32_t kMostSmallTriangles = 64;

/// A leaf of a small scene: its box, and a bit for each entry of BvhView::triangles, the first 32 in `first_triangles`.
struct alignas(16) SmallLeaf {
    Vec3f low{kInfinity};
    std::uint32_t first_triangles = 0;
    Vec3f high{-kInfinity};
    std::uint32_t last_triangles = 0;
};
static_assert(sizeof(SmallLeaf) == 32 && kMostSmallTriangles <= 64);

struct BvhView {
    Span<const BvhNode> nodes;          ///< root first; empty for an empty scene
    Span<const SmallLeaf> leaves;       ///< of `nodes` once more, in their order; empty unless the scene is small
    Span<const BvhTriangle> triangles;  ///< in the order of the leaves
};

/// A ray prepared for slab tests: the planes x = low - slack and x = high + slack are crossed at the distances
/// low inverse_direction + at_low and high inverse_direction + at_high.
struct BoxRay {
    Vec3f inverse_direction;
    Vec3f at_low;
    Vec3f at_high;
};

/// Boxes are enlarged by a slack s on all sides, so that no box with the closest hit is skipped and traversal agrees bit by bit
/// with a test of all triangles. With u the roundoff, A the largest component of the origin o, R the largest
/// component of the scene's corners seen from o, d the direction and D its largest component:
///   - The triangle test displaces corners by up to 8 u R across the ray and its distance by 10: a hit at the distance t lies in
///     the box enlarged by 18 u R on each axis, low - 18 u R <= o + t d <= high + 18 u R.
///   - The distance of a plane is computed as t' = (low i + a)(1 + e) with i = (1 + e) / d and a = -(o + s)(1 + e)^2 i, where
///     each e is another one of at most u; the last is at most 2 u, and the product low i has one more unless it is fused. So t' d
///     differs from q = low - o - s by at most 3 u |q| + u |low| + 2 u |o + s| <= u (4 R + 3 A + 5 s).
///   - A component of the direction below 2^-40 D is set to 2^-40 D, which keeps its inverse finite and moves the
///     point at t by less than 2^-40 (R + 18 u R).
/// The test then passes if s >= u (22 R + 3 A) (1 + 8 u) + 2^-39 R. The rest of 32 R + 4 A is for the rounding of s and R.
/// (The bound does not cover triangles thinner than a few roundings of their corners: all their edge functions may be rounding errors,
/// and the triangle test then accept rays that pass beside them, one in 1e6 of the rays aimed there.)
template <class Real>
PL_INLINE Real box_slack(const Real& reach, const Real& origin) {
    return kRoundoff * (32.0f * reach + 4.0f * origin);
}

/// A BoxRay along one axis.
template <class N>
struct BoxAxis {
    typename N::Real inverse_direction, at_low, at_high;
};

/// `longest`: the largest component of the direction; `size`: a bound on the coordinates.
template <class N>
PL_INLINE BoxAxis<N> make_box_axis(const typename N::Real& origin, const typename N::Real& direction,
                                   const typename N::Real& longest, const typename N::Real& size,
                                   const typename N::Real& slack) {
    constexpr float kLeastComponent = 0x1p-40f;
    const typename N::Real component = N::magnitude(direction);
    const typename N::Real least = kLeastComponent * longest;
    const auto inverse =
        1.0f / N::copy_sign(select(static_cast<typename N::Mask>(component < least), least, component), direction);
    // Distances beyond the range of float: every box passes.
    const typename N::Mask is_bounded = 4.0f * size * N::magnitude(inverse) < kInfinity;
    return {select(is_bounded, inverse, N::constant(0.0f)),
            select(is_bounded, -(origin + slack) * inverse, N::constant(-kInfinity)),
            select(is_bounded, -(origin - slack) * inverse, N::constant(kInfinity))};
}
PL_HD inline BoxRay make_box_ray(const Ray& ray, float size, float slack) {
    const float longest = max_component(absolute(ray.direction));
    BoxRay box;
    for (int i = 0; i < 3; ++i) {
        const auto axis = make_box_axis<One>(ray.origin[i], ray.direction[i], longest, size, slack);
        box.inverse_direction[i] = axis.inverse_direction;
        box.at_low[i] = axis.at_low;
        box.at_high[i] = axis.at_high;
    }
    return box;
}
PL_HD inline BoxRay make_box_ray(const BvhNode& root, const Ray& ray) {
    const float reach = max_component(glm::max(absolute(root.low - ray.origin), absolute(root.high - ray.origin)));
    const float origin = max_component(absolute(ray.origin));
    return make_box_ray(ray, reach + origin, box_slack(reach, origin));
}

/// Conservative slab test: false positives only. Returns the entry distance, or infinity if the ray misses the box or
/// enters it beyond `t_max`. `node` is a BvhNode or a SmallLeaf; `multiply_add` is bound_multiply_add(), except in
/// tests of either rounding.
template <class Node, class MultiplyAdd>
PL_HD inline float intersect_box(const Node& node, const BoxRay& ray, float t_max, const MultiplyAdd& multiply_add) {
    float entry = 0.0f;
    float exit = t_max;
    for (int axis = 0; axis < 3; ++axis) {
        const float t0 = multiply_add(node.low[axis], ray.inverse_direction[axis], ray.at_low[axis]);
        const float t1 = multiply_add(node.high[axis], ray.inverse_direction[axis], ray.at_high[axis]);
        const FloatPair crossed = in_order(t0, t1);
        entry = in_order(entry, crossed.low).high;
        exit = in_order(exit, crossed.high).low;
    }
    return entry <= exit ? entry : kInfinity;
}
template <class Node>
PL_HD inline float intersect_box(const Node& node, const BoxRay& ray, float t_max) {
    return intersect_box(node, ray, t_max, [](float a, float b, float c) { return bound_multiply_add(a, b, c); });
}

/// A ray with a NaN or infinite component, or without a direction, hits nothing, but passes every slab test: it is rejected in
/// advance.
PL_HD inline bool can_hit(const Ray& ray) {
    const Vec3f size = absolute(ray.direction);
    const Vec3f sum = absolute(ray.origin) + size;
    return sum.x + sum.y + sum.z < kInfinity && max_component(size) > 0.0f;
}

/// Memory for the nodes that a traversal has still to visit: apart from its other members, which else would share its memory on a
/// device instead of being registers.
struct NodeMemory {
    NodeReference entries[kMaxBvhDepth];
};

class NodeStack {
public:
    PL_HD explicit NodeStack(NodeMemory& memory) : entries_(memory.entries) {}

    PL_HD bool is_empty() const { return depth_ == 0; }
    PL_HD void push(NodeReference node) {
        PL_ASSERT(depth_ < kMaxBvhDepth);
        entries_[depth_++] = node;
    }
    PL_HD NodeReference pop() { return entries_[--depth_]; }

private:
    NodeReference* entries_;
    int depth_ = 0;
};

/// The children of a node, and the distances at which a ray enters them, see intersect_box().
struct NodePair {
    NodeReference left, right;
    float left_t, right_t;

    PL_HD bool enters_any() const { return in_order(left_t, right_t).low != kInfinity; }
    PL_HD bool enters_both() const { return in_order(left_t, right_t).high != kInfinity; }
    PL_HD NodeReference near() const { return right_t < left_t ? right : left; }
    PL_HD NodeReference far() const { return right_t < left_t ? left : right; }
};
PL_HD inline NodePair intersect_children(const BvhNode* nodes, NodeReference parent, const BoxRay& ray, float t_max) {
    const BvhNode left = nodes[parent.first()];
    const BvhNode right = nodes[parent.first() + 1];
    return {left.reference(), right.reference(), intersect_box(left, ray, t_max), intersect_box(right, ray, t_max)};
}

/// Visits the triangles of a leaf: `visit(triangle, best)` updates the closest hit and returns true to stop. Returns whether it did.
template <class Visit>
PL_HD inline bool visit_leaf(const BvhTriangle* triangles, NodeReference leaf, Hit& best, Visit&& visit) {
    for (std::uint32_t i = 0; i < leaf.count(); ++i) {
        const BvhTriangle triangle = triangles[leaf.first() + i];
        if (visit(triangle, best)) return true;
    }
    return false;
}

/// Visits the leaves below a node that the ray may enter, nearer children first, until `visit(leaf, best)` returns true to stop. Nodes
/// beyond the closest hit are culled. Returns whether it stopped.
template <class Visit>
PL_HD inline bool traverse_nodes(const BvhNode* nodes, const BvhNode& root, const BoxRay& ray, Hit& best,
                                 Visit&& visit) {
    if (intersect_box(root, ray, best.t) == kInfinity) return false;
    NodeMemory memory;
    NodeStack stack(memory);
    NodeReference current = root.reference();
    while (true) {
        if (current.count() > 0) {
            if (visit(current, best)) return true;
        } else {
            const NodePair pair = intersect_children(nodes, current, ray, best.t);
            if (pair.enters_both()) stack.push(pair.far());
            if (pair.enters_any()) {
                current = pair.near();
                continue;
            }
        }
        if (stack.is_empty()) return false;
        current = stack.pop();
    }
}

/// Visits the triangles of all leaves that the ray may enter, until visit_leaf() stops.
template <class Visit>
PL_HD inline void traverse(const BvhView& bvh, const Ray& ray, Hit& best, Visit&& visit) {
    if (bvh.nodes.empty() || !can_hit(ray)) return;
    const BvhNode root = bvh.nodes[0];
    traverse_nodes(bvh.nodes.data, root, make_box_ray(root, ray), best,
                   [&](NodeReference leaf, Hit& hit) { return visit_leaf(bvh.triangles.data, leaf, hit, visit); });
}

}  // namespace pl
