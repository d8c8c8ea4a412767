// Surface points and volumes at the ends of a block of rays, looked up ahead of the paths' steps: in loops of their own lookups
// overlap, and each step prefetches the memory of the next one, since grids are larger than the innermost caches. The loops are
// the same for every set of features and compiled once.
#pragma once

#include <concepts>

#include "core/kernel/methods/guided.h"
#include "cpu/ray_batch.h"

namespace pl {

/// Paths per block: few enough for the innermost cache.
inline constexpr std::uint32_t kGuidedBlock = 64;

/// A method guided by tables that is given the volume of the next surface point, or nullptr: then locate() looks it up.
template <class M>
struct LookedUpAhead : M {
    const FoundVolume* found = nullptr;

    typename M::Vertex locate(const SurfacePoint& surface, MethodCounters& counters) const {
        return found != nullptr ? M::count_lookup({found->volume, found->node}, counters)
                                : M::locate(surface, counters);
    }
};

/// The volumes at the ends of at most kGuidedBlock rays.
class LookupsAhead {
public:
    /// Prefetches the grid cells of rays first to end, exclusive. Rays that miss, or hit a surface that does not reflect, are
    /// left out.
    void begin(const SceneView& scene, const PlacementView& placement, const RayBatch& rays, std::uint32_t first,
               std::uint32_t end);
    /// Finds the volumes. Best called after other work, when the prefetched cells have arrived.
    void finish(const PlacementView& placement);
    /// The surface point at the end of a ray that hits something.
    template <FeatureSet F>
    decltype(auto) surface(const SceneView& scene, const Hit& hit, std::uint32_t ray) const {
        if constexpr (F.has(Feature::SmoothNormals))
            return with_shading_normal<F>(scene, points_[ray - first_], hit_weights(hit));
        else
            return (points_[ray - first_]);
    }
    /// nullptr for rays that were left out.
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
    static_assert(kGuidedBlock <= 64);
    Pending pending_[kGuidedBlock];
    FoundVolume found_[kGuidedBlock];
    SurfacePoint points_[kGuidedBlock];
};

}  // namespace pl
