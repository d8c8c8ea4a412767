// Groups of rays prepared for the wide hierarchy. Included by one file per instruction set; see lanes.h.
#pragma once

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

/// As in make_box_ray(): magnitudes that bound the roundoff of a ray's tests.
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

}  // namespace
}  // namespace pl
