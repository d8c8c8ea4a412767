// Surface points and volumes at the hits of a block of rays, looked up in SIMD lanes before the paths are shaded: the lookups of a
// vector overlap, and each loop prefetches the data of the next, since grids exceed the L1 and L2 caches. The loops do not depend on
// the set of features and are compiled once.
#pragma once

#include <concepts>

#include "core/kernel/methods/guided.h"
#include "cpu/base/lane_kernels.h"
#include "cpu/base/surface_block.h"

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
    explicit LookupsAhead(const LaneKernels& kernels = best_lane_kernels()) : kernels_(kernels), surfaces_(kernels) {}

    /// Prefetches the grid cells of rays [first, end); `first` is a multiple of kGroupSize. Skips rays that miss, or hit a surface
    /// that does not reflect.
    void begin(const SceneView& scene, const PlacementView& placement, const RayBatch& rays, std::uint32_t first,
               std::uint32_t end);
    /// Completes the lookups. Best called after other work, which hides the latency of the prefetched cells.
    void finish(const SceneView& scene, const PlacementView& placement);
    /// The surface points at the hits of all rays, with the volumes that are known.
    PointGroup* points() { return surfaces_.points(); }
    /// The rays whose volumes are known, one bit each.
    std::uint64_t found() const { return wanted_; }
    /// Whether the volume at the hit of a ray is known; not for skipped rays.
    bool is_found(std::uint32_t ray) const { return ((wanted_ >> (ray - first_)) & 1u) != 0; }
    /// The volume of a ray that is_found().
    FoundVolume found(std::uint32_t ray) const {
        const PointGroup& group = surfaces_.points()[(ray - first_) / kGroupSize];
        const std::uint32_t lane = (ray - first_) % kGroupSize;
        return {group.volume[lane], group.node[lane]};
    }

private:
    static_assert(kPathBlock <= 64);
    LaneKernels kernels_;
    std::uint32_t first_ = 0;
    std::uint64_t wanted_ = 0;        ///< one bit per ray whose volume is looked up
    const HitGroup* hits_ = nullptr;  ///< of the rays
    SurfaceBlock surfaces_;
};

}  // namespace pl
