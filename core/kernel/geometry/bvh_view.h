// Bounding volume hierarchy as an array of 32-byte nodes, and its traversal.
#pragma once

#include "core/kernel/base/span.h"
#include "core/kernel/geometry/triangle.h"

namespace pl {

/// Inner node: `count` is 0 and the children are nodes `first` and `first + 1`. Leaf: `count` entries of
/// BvhView::primitives from `first` on.
struct BvhNode {
    Vec3f low{kInfinity};
    std::uint32_t first = 0;
    Vec3f high{-kInfinity};
    std::uint32_t count = 0;
};
static_assert(sizeof(BvhNode) == 32);

/// build_bvh() keeps the depth below this bound, so the traversal stack cannot overflow.
inline constexpr int kMaxBvhDepth = 64;

struct BvhView {
    Span<const BvhNode> nodes;  ///< root first; empty for an empty scene
    Span<const std::uint32_t> primitives;
};

/// A ray prepared for slab tests.
struct BoxRay {
    Vec3f origin;
    Vec3f inverse_direction;
    float slack;  ///< distance by which boxes are enlarged
};

/// The triangle test displaces corners by up to 8 roundoffs of their distance across the ray and its distance by 10;
/// a slab distance has 3. Boxes enlarged by 32 roundoffs of the largest distance in the scene cover the sum, so no
/// box with the closest hit is skipped and traversal agrees bit by bit with a test of all triangles. (The bound does
/// not cover triangles without area, which loaders remove: of rays aimed at them about one in 1e6 differs.)
PL_HD inline BoxRay make_box_ray(const BvhNode& root, const Ray& ray) {
    const Vec3f reach = glm::max(absolute(root.low - ray.origin), absolute(root.high - ray.origin));
    const Vec3f d = ray.direction;
    return {ray.origin, {1.0f / d.x, 1.0f / d.y, 1.0f / d.z}, 32.0f * kRoundoff * max_component(reach)};
}

/// Conservative slab test: false positives only. Returns the entry distance, or infinity if the ray misses the box or
/// enters it beyond `t_max`.
PL_HD inline float intersect_box(const BvhNode& node, const BoxRay& ray, float t_max) {
    float entry = 0.0f;
    float exit = t_max;
    for (int axis = 0; axis < 3; ++axis) {
        const float t0 = (node.low[axis] - ray.origin[axis] - ray.slack) * ray.inverse_direction[axis];
        const float t1 = (node.high[axis] - ray.origin[axis] + ray.slack) * ray.inverse_direction[axis];
        // 0 * infinity is NaN: the origin lies on a slab parallel to the ray, which does not narrow the interval.
        if (t0 != t0 || t1 != t1) continue;
        const float near = min_of(t0, t1);
        const float far = max_of(t0, t1);
        if (near > entry) entry = near;
        if (far < exit) exit = far;
    }
    return entry <= exit ? entry : kInfinity;
}

/// A ray with a NaN or infinite component hits nothing, but passes every slab test: it is rejected in advance.
PL_HD inline bool is_finite(const Ray& ray) {
    const Vec3f sum = absolute(ray.origin) + absolute(ray.direction);
    return sum.x + sum.y + sum.z < kInfinity;
}

/// Visits the triangles of all leaves that the ray may enter, nearer children first. `visit(primitive, best)` updates
/// the closest hit and returns true to stop. Nodes beyond the closest hit are culled.
template <class Visit>
PL_HD inline void traverse(const BvhView& bvh, const Ray& ray, Hit& best, Visit&& visit) {
    if (bvh.nodes.empty() || !is_finite(ray)) return;
    const BoxRay box_ray = make_box_ray(bvh.nodes[0], ray);
    std::uint32_t stack[kMaxBvhDepth];
    int depth = 0;
    std::uint32_t current = 0;
    if (intersect_box(bvh.nodes[0], box_ray, best.t) == kInfinity) return;
    while (true) {
        const BvhNode& node = bvh.nodes[current];
        if (node.count > 0) {
            for (std::uint32_t i = 0; i < node.count; ++i)
                if (visit(bvh.primitives[node.first + i], best)) return;
        } else {
            std::uint32_t near = node.first;
            std::uint32_t far = node.first + 1;
            float near_t = intersect_box(bvh.nodes[near], box_ray, best.t);
            float far_t = intersect_box(bvh.nodes[far], box_ray, best.t);
            if (far_t < near_t) {
                const std::uint32_t node_swap = near;
                near = far;
                far = node_swap;
                const float t_swap = near_t;
                near_t = far_t;
                far_t = t_swap;
            }
            if (far_t != kInfinity) {
                PL_ASSERT(depth < kMaxBvhDepth);
                stack[depth++] = far;
            }
            if (near_t != kInfinity) {
                current = near;
                continue;
            }
        }
        if (depth == 0) return;
        current = stack[--depth];
    }
}

}  // namespace pl
