// Surface points and volumes at the hits of a block of rays, looked up before the paths are shaded. In separate loops
// the lookups overlap, and each loop prefetches the data of the next, since grids exceed the L1 and L2 caches. The
// loops do not depend on the set of features and are compiled once.
#pragma once

#include <concepts>

#include "core/kernel/methods/guided.h"
#include "cpu/ray_batch.h"

namespace pl {

/// A method guided by tables. `found` is the volume of the next surface point; if nullptr, locate() looks it up.
template <class M>
struct LookedUpAhead : M {
    const FoundVolume* found = nullptr;

    typename M::Vertex locate(const SurfacePoint& surface, MethodCounters& counters) const {
        return found != nullptr ? M::count_lookup({found->volume, found->node}, counters)
                                : M::locate(surface, counters);
    }
};

/// The volumes at the hits of at most kPathBlock rays.
class LookupsAhead {
public:
    /// Prefetches the grid cells of rays [first, end). Skips rays that miss, or hit a surface that does not reflect.
    void begin(const SceneView& scene, const PlacementView& placement, const RayBatch& rays, std::uint32_t first,
               std::uint32_t end);
    /// Completes the lookups. Best called after other work, which hides the latency of the prefetched cells.
    void finish(const PlacementView& placement);
    /// The surface point at the hit of a ray; undefined for rays that miss.
    template <FeatureSet F>
    decltype(auto) surface(const SceneView& scene, const Hit& hit, std::uint32_t ray) const {
        if constexpr (F.has(Feature::SmoothNormals))
            return with_shading_normal<F>(scene, points_[ray - first_], hit_weights(hit));
        else
            return (points_[ray - first_]);
    }
    /// The volume at the hit of a ray; nullptr for skipped rays.
    const FoundVolume* found(std::uint32_t ray) const {
        return ((known_ >> (ray - first_)) & 1u) != 0 ? &found_[ray - first_] : nullptr;
    }

private:
    struct Pending {
        VolumePlace place;
        std::uint32_t ray;
    };

    std::uint32_t first_ = 0;
    std::uint32_t count_ = 0;
    std::uint64_t known_ = 0;  ///< one bit per ray
    static_assert(kPathBlock <= 64);
    Pending pending_[kPathBlock];
    FoundVolume found_[kPathBlock];
    SurfacePoint points_[kPathBlock];
};

}  // namespace pl
