// Groups of rays prepared for the wide hierarchy, and a ray's way through its nodes: a node's children are tested in lanes. Included by
// one file per instruction set; see lanes.h.
#pragma once

#include <bit>
#include <cstddef>

#include "cpu/base/lane_kernels.h"
#include "cpu/lanes/dense_lanes.h"

namespace pl {
namespace {

/// 16 rays prepared for the tests of boxes, see BoxRay, and of triangles, see RaySpace: rows, of which a traversal reads
/// one lane.
struct alignas(64) PreparedGroup {
    float inverse_direction[3][kGroupSize];
    float at[3][2][kGroupSize];              ///< [axis][near or far plane]
    std::uint32_t near_side[3][kGroupSize];  ///< 0: the near plane of a box is its low one, 1: its high one
    float origin[3][kGroupSize];             ///< with permuted axes
    float shear_x[kGroupSize], shear_y[kGroupSize], scale_z[kGroupSize];
    std::uint32_t first_axis[kGroupSize];  ///< the axis that is x in ray space; y and z follow in cyclic order
    std::uint32_t can_hit;                 ///< bit i: can_hit() of ray i
};

/// Magnitudes that bound the roundoff of a ray's tests, see make_box_ray().
struct RayBounds {
    LaneFloat reach{}, distance{}, longest{}, sum{};

    PL_INLINE RayBounds(const BvhNode& root, const LaneFloat (&origin)[3], const LaneFloat (&direction)[3]) {
        for (int axis = 0; axis < 3; ++axis) {
            reach = larger(reach, larger(magnitude(broadcast(root.low[axis]) - origin[axis]),
                                         magnitude(broadcast(root.high[axis]) - origin[axis])));
            distance = larger(distance, magnitude(origin[axis]));
            longest = larger(longest, magnitude(direction[axis]));
            sum += magnitude(origin[axis]) + magnitude(direction[axis]);
        }
    }
};

/// The planes of make_box_axis(), in the order in which a ray meets them.
PL_INLINE void prepare_for_boxes(const BvhNode& root, const RayGroup& rays, std::uint32_t first,
                                 PreparedGroup& prepared) {
    const LaneFloat origin[3] = {load_lanes<LaneFloat>(rays.origin_x + first),
                                 load_lanes<LaneFloat>(rays.origin_y + first),
                                 load_lanes<LaneFloat>(rays.origin_z + first)};
    const LaneFloat direction[3] = {load_lanes<LaneFloat>(rays.direction_x + first),
                                    load_lanes<LaneFloat>(rays.direction_y + first),
                                    load_lanes<LaneFloat>(rays.direction_z + first)};
    const RayBounds bounds(root, origin, direction);
    const LaneFloat size = bounds.reach + bounds.distance;
    const LaneFloat slack = box_slack(bounds.reach, bounds.distance);
    for (int axis = 0; axis < 3; ++axis) {
        const auto box = make_box_axis<Lanes>(origin[axis], direction[axis], bounds.longest, size, slack);
        const LaneInt is_backward = box.inverse_direction < 0.0f;
        store_lanes(box.inverse_direction, prepared.inverse_direction[axis] + first);
        store_lanes(is_backward ? box.at_high : box.at_low, prepared.at[axis][0] + first);
        store_lanes(is_backward ? box.at_low : box.at_high, prepared.at[axis][1] + first);
        store_lanes(is_backward & 1, prepared.near_side[axis] + first);
    }
    prepared.can_hit |= mask_bits((bounds.sum < kInfinity) & (bounds.longest > 0.0f)) << first;
}

PL_INLINE void prepare_for_triangles(const RayGroup& rays, std::uint32_t first, PreparedGroup& prepared) {
    LaneRaySpace space = load_ray_space(rays, first);
    permute_axes(space.along_x, space.along_y, space.origin_x, space.origin_y, space.origin_z);
    store_lanes(space.origin_x, prepared.origin[0] + first);
    store_lanes(space.origin_y, prepared.origin[1] + first);
    store_lanes(space.origin_z, prepared.origin[2] + first);
    store_lanes(space.shear_x, prepared.shear_x + first);
    store_lanes(space.shear_y, prepared.shear_y + first);
    store_lanes(space.scale_z, prepared.scale_z + first);
    store_lanes((space.along_x & 1) | (space.along_y & 2), prepared.first_axis + first);
}

PL_INLINE void prepare(const BvhNode& root, const RayGroup& rays, PreparedGroup& prepared) {
    prepared.can_hit = 0;
    for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth) {
        prepare_for_boxes(root, rays, first, prepared);
        prepare_for_triangles(rays, first, prepared);
    }
}

/// A child to be visited and the distance at which the ray enters it, as one number: sorted by distance.
using EnteredChild = std::uint64_t;
constexpr EnteredChild kNoChild = ~EnteredChild{0};

PL_INLINE EnteredChild entered_child(float entry, WideReference child) {
    return (EnteredChild{std::bit_cast<std::uint32_t>(entry)} << 32) | child.bits;
}
PL_INLINE float entry_of(EnteredChild child) { return std::bit_cast<float>(static_cast<std::uint32_t>(child >> 32)); }
PL_INLINE WideReference reference_of(EnteredChild child) { return {static_cast<std::uint32_t>(child)}; }

/// One ray of a prepared group, for the boxes of nodes.
struct GroupRay {
    const PreparedGroup* group;
    std::uint32_t lane;

    PL_INLINE float inverse_direction(int axis) const { return group->inverse_direction[axis][lane]; }
    PL_INLINE float at(int axis, int plane) const { return group->at[axis][plane][lane]; }
    PL_INLINE std::uint32_t near_side(int axis) const { return group->near_side[axis][lane]; }
};

/// intersect_box() of all children: a bit for each that the ray enters, and the distances at which it does. `Ray` has the functions
/// of GroupRay.
template <class Ray>
PL_INLINE std::uint32_t enter_children(const WideNode& node, const Ray& ray, float t_max, float* entries) {
    std::uint32_t entered = 0;
    for (std::uint32_t first = 0; first < kWideChildren; first += kTestWidth) {
        TestFloat entry{};
        TestFloat exit = broadcast_to<TestFloat>(t_max);
        for (int axis = 0; axis < 3; ++axis) {
            const auto inverse = broadcast_to<TestFloat>(ray.inverse_direction(axis));
            const std::uint32_t side = ray.near_side(axis);
            const auto near = load_lanes<TestFloat>(node.planes[axis][side] + first);
            const auto far = load_lanes<TestFloat>(node.planes[axis][side ^ 1] + first);
            entry = larger(near * inverse + broadcast_to<TestFloat>(ray.at(axis, 0)), entry);
            exit = smaller(far * inverse + broadcast_to<TestFloat>(ray.at(axis, 1)), exit);
        }
        store_lanes(entry, entries + first);
        entered |= mask_bits(entry <= exit) << first;
    }
    return entered & node.child_bits;
}

/// The children that a ray has still to visit, nearer ones first; children beyond the closest hit, at `t_max`, are
/// culled.
class NodeWalk {
public:
    /// Starts at an inner node. `stack` has room for kWideStack children.
    PL_INLINE void start(std::uint32_t root, EnteredChild* stack) {
        top_ = bottom_ = stack;
        next_ = entered_child(0.0f, {root << WideReference::kCountBits});
    }
    PL_INLINE void stop() { next_ = kNoChild; }

    PL_INLINE bool is_over() const { return next_ == kNoChild; }
    PL_INLINE bool is_at_leaf() const { return at().count() > 0; }
    PL_INLINE WideReference at() const { return reference_of(next_); }

    /// Goes on from an inner node to the nearest child that the ray enters; the others wait.
    template <class Ray>
    PL_INLINE void descend(const WideNode* nodes, const Ray& ray, float t_max) {
        const WideNode& node = nodes[at().first()];
        alignas(32) float entries[kWideChildren];
        std::uint32_t entered = enter_children(node, ray, t_max, entries);
        const auto take = [&] {
            const auto i = static_cast<std::uint32_t>(std::countr_zero(entered));
            entered &= entered - 1;
            return entered_child(entries[i], node.children[i]);
        };
        if (entered == 0) return leave(t_max);
        next_ = take();
        EnteredChild* const first = top_;
        while (entered != 0) push(take(), first);
    }
    /// Goes on from a leaf.
    PL_INLINE void leave(float t_max) {
        while (top_ != bottom_) {
            next_ = *--top_;
            if (!(entry_of(next_) > t_max)) return;
        }
        next_ = kNoChild;
    }

private:
    /// Keeps the nearest child as the next one, and the children from `first` on sorted, the nearest on top.
    PL_INLINE void push(EnteredChild child, const EnteredChild* first) {
        const EnteredChild farther = max_of(child, next_);
        next_ = min_of(child, next_);
        EnteredChild* place = top_++;
        for (; place != first && place[-1] < farther; --place) *place = place[-1];
        *place = farther;
    }

    EnteredChild next_;
    EnteredChild* top_;
    EnteredChild* bottom_;
};

}  // namespace
}  // namespace pl
