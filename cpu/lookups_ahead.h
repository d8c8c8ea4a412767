// Surface points and volumes at the hits of a block of rays, looked up in SIMD lanes before the paths are shaded: the lookups of a
// vector overlap, and each loop prefetches the data of the next, since grids exceed the L1 and L2 caches. The loops do not depend on
// the set of features and are compiled once.
#pragma once

#include <concepts>

#include "core/kernel/methods/guided.h"
#include "cpu/lane_kernels.h"
#include "cpu/ray_batch.h"

namespace pl {

/// A method guided by tables. `found` is the volume of the next surface point, if it `is_found`; else locate() looks it up.
template <class M>
struct LookedUpAhead : M {
    FoundVolume found;
    bool is_found = false;

    typename M::Vertex locate(const SurfacePoint& surface, MethodCounters& counters) const {
        return is_found ? M::count_lookup({found.volume, found.node}, counters) : M::locate(surface, counters);
    }
};

/// The volumes at the hits of at most kPathBlock rays.
class LookupsAhead {
public:
    explicit LookupsAhead(const LaneKernels& kernels = best_lane_kernels()) : kernels_(kernels) {}

    /// Prefetches the grid cells of rays [first, end); `first` is a multiple of kGroupSize. Skips rays that miss, or hit a surface
    /// that does not reflect.
    void begin(const SceneView& scene, const PlacementView& placement, const RayBatch& rays, std::uint32_t first,
               std::uint32_t end);
    /// Completes the lookups. Best called after other work, which hides the latency of the prefetched cells.
    void finish(const SceneView& scene, const PlacementView& placement);
    /// The surface points at the hits of all rays.
    const PointGroup* points() const { return points_; }
    /// The surface point at the hit of a ray; undefined for rays that miss.
    template <FeatureSet F>
    SurfacePoint surface(const SceneView& scene, const Hit& hit, std::uint32_t ray) const {
        // Not copied without need: the wide loads of a copy would stall, since narrower stores do not forward to them.
        if constexpr (F.has_any(kNormalFeatures))
            return with_shading_normal<F>(scene, flat_point(ray - first_, hit.primitive), hit_weights(hit));
        else
            return flat_point(ray - first_, hit.primitive);
    }
    /// Whether the volume at the hit of a ray is known; not for skipped rays.
    bool is_found(std::uint32_t ray) const { return ((wanted_ >> (ray - first_)) & 1u) != 0; }
    /// The volume of a ray that is_found().
    FoundVolume found(std::uint32_t ray) const {
        const PointGroup& group = points_[(ray - first_) / kGroupSize];
        const std::uint32_t lane = (ray - first_) % kGroupSize;
        return {group.volume[lane], group.node[lane]};
    }

private:
    SurfacePoint flat_point(std::uint32_t i, std::uint32_t primitive) const {
        const PointGroup& group = points_[i / kGroupSize];
        const std::uint32_t lane = i % kGroupSize;
        const Vec3f normal = group.geometric_normal.get(lane);
        return {.position = group.position.get(lane),
                .geometric_normal = normal,
                .shading_normal = normal,
                .position_error = group.position_error[lane],
                .primitive = primitive,
                .material = group.material[lane],
                .front = group.front[lane] != 0};
    }

    static_assert(kPathBlock <= 64);
    LaneKernels kernels_;
    std::uint32_t first_ = 0;
    std::uint32_t groups_ = 0;
    std::uint64_t wanted_ = 0;  ///< one bit per ray whose volume is looked up
    std::uint32_t primitives_[kPathBlock];
    PointGroup points_[kBlockGroups];
};

}  // namespace pl
