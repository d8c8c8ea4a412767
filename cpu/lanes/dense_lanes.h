// Intersection of a vector of rays with every triangle. Included by one file per instruction set; see lanes.h.
#pragma once

#include "cpu/base/lane_kernels.h"
#include "cpu/lanes/lane_triangle.h"
#include "cpu/lanes/lanes.h"

namespace pl {
namespace {

using LaneRaySpace = RaySpace<LaneFloat, LaneInt>;
using LaneCorner = RayVector<LaneFloat>;
using LaneEdges = EdgeFunctions<LaneFloat>;

/// The rays of a group from lane `first`, transformed for the watertight test.
PL_INLINE LaneRaySpace load_ray_space(const RayGroup& rays, std::uint32_t first) {
    const RayVector<LaneFloat> origin{load_lanes<LaneFloat>(rays.origin_x + first),
                                      load_lanes<LaneFloat>(rays.origin_y + first),
                                      load_lanes<LaneFloat>(rays.origin_z + first)};
    const RayVector<LaneFloat> direction{load_lanes<LaneFloat>(rays.direction_x + first),
                                         load_lanes<LaneFloat>(rays.direction_y + first),
                                         load_lanes<LaneFloat>(rays.direction_z + first)};
    return make_ray_space<LaneFloat, LaneInt>(
        origin, direction, {magnitude(direction.x), magnitude(direction.y), magnitude(direction.z)}, broadcast(1.0f));
}

/// Intersects one vector of rays with the triangles of a scene.
class DenseLanes {
public:
    PL_INLINE DenseLanes(const DenseView& scene, const RayGroup& rays, std::uint32_t first)
        : scene_(scene), source_(load_lanes<LaneUint>(rays.source + first)),
          target_(load_lanes<LaneUint>(rays.target + first)), t_max_(load_lanes<LaneFloat>(rays.t_max + first)) {
        const LaneRaySpace space = load_ray_space(rays, first);
        for (std::uint32_t i = 0; i < scene.position_count; ++i) {
            const Vec3f& p = scene.positions[i];
            corners_[i] = to_ray_space(space, broadcast(p.x), broadcast(p.y), broadcast(p.z));
        }
    }

    /// Whether a ray excludes a target.
    PL_INLINE bool has_targets() const { return !LaneFlags(target_ == broadcast(kNoPrimitive)).all(); }

    /// `kTargets`: has_targets().
    template <bool kTargets>
    PL_INLINE void find_closest(HitGroup& hits, std::uint32_t first) const {
        // Triangles come in ascending order, so the first of several equal distances is the closest; nothing is
        // closer than NaN.
        LaneFloat best_t = broadcast(kNan);
        LaneUint best_primitive = broadcast(kNoPrimitive);
        LaneFloat best_v{}, best_w{};
        LaneFloat best_determinant = broadcast(1.0f);
        for (std::uint32_t i = 0; i < scene_.triangle_count; ++i) {
            const Crossing crossing = cross<kTargets>(scene_.triangles[i]);
            const LaneFlags take = crossing.hit & is_not_at_least(crossing.t, best_t);
            best_t = take.choose(crossing.t, best_t);
            best_primitive = take.choose(broadcast(scene_.triangles[i].primitive), best_primitive);
            best_v = take.choose(crossing.edges.v, best_v);
            best_w = take.choose(crossing.edges.w, best_w);
            best_determinant = take.choose(crossing.determinant, best_determinant);
        }
        const LaneFlags found = is_at_most(best_t, t_max_);
        store_lanes(found.choose(best_t, t_max_), hits.t + first);
        store_lanes(found.choose(best_primitive, broadcast(kNoPrimitive)), hits.primitive + first);
        store_lanes(found.choose(best_v / best_determinant, LaneFloat{}), hits.b1 + first);
        store_lanes(found.choose(best_w / best_determinant, LaneFloat{}), hits.b2 + first);
    }

    /// Occlusion mask, one bit per lane.
    PL_INLINE std::uint32_t find_occluded() const {
        constexpr std::uint32_t kAllLanes = (1u << kLaneWidth) - 1u;
        std::uint32_t occluded = 0;
        for (std::uint32_t i = 0; i < scene_.triangle_count && occluded != kAllLanes; ++i) {
            const Crossing crossing = cross<true>(scene_.triangles[i]);
            occluded |= (crossing.hit & is_at_most(crossing.t, t_max_)).bits();
        }
        return occluded;
    }

private:
    struct Crossing {
        LaneEdges edges;
        LaneFloat determinant;
        LaneFloat t;
        LaneFlags hit;  ///< intersected at t > 0, and the triangle is neither source nor target
    };

    template <bool kTargets>
    PL_INLINE Crossing cross(const DenseTriangle& triangle) const {
        const LaneCorner& a = corners_[triangle.a];
        const LaneCorner& b = corners_[triangle.b];
        const LaneCorner& c = corners_[triangle.c];
        LaneEdges e = edge_functions(a, b, c);
        LaneFlags outside = have_different_signs(e.u, e.v, e.w);
        const std::uint32_t zero = (is_zero(e.u) | is_zero(e.v) | is_zero(e.w)).bits();
        if (__builtin_expect(zero != 0, 0)) outside = LaneFlags(~repeat_exactly_in(a, b, c, zero, e));
        const LaneFloat determinant = e.u + e.v + e.w;
        const LaneFloat t = scaled_distance(e, a, b, c) / determinant;
        LaneFlags excluded = outside | is_equal(source_, triangle.primitive);
        if constexpr (kTargets) excluded = excluded | is_equal(target_, triangle.primitive);
        return {e, determinant, t, without(is_positive(t), excluded)};
    }

    const DenseView& scene_;
    LaneUint source_, target_;
    LaneFloat t_max_;
    LaneCorner corners_[kMaxDensePositions];
};

void find_closest(const DenseView& scene, const RayGroup* rays, HitGroup* hits, std::uint32_t groups) {
    for (std::uint32_t group = 0; group < groups; ++group)
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth) {
            const DenseLanes lanes(scene, rays[group], first);
            if (lanes.has_targets())
                lanes.find_closest<true>(hits[group], first);
            else
                lanes.find_closest<false>(hits[group], first);
        }
}

void find_occluded(const DenseView& scene, const RayGroup* rays, OcclusionMask* masks, std::uint32_t groups) {
    for (std::uint32_t group = 0; group < groups; ++group) {
        std::uint32_t bits = 0;
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
            bits |= DenseLanes(scene, rays[group], first).find_occluded() << first;
        masks[group] = static_cast<OcclusionMask>(bits);
    }
}

}  // namespace
}  // namespace pl
