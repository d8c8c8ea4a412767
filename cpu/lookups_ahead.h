// Where the rays of a block of paths end, and the volumes that serve them there, found before the paths arrive: one after
// the other in a loop of their own lookups overlap, and each step asks for the memory of the next one. Cells are larger than
// the innermost caches. The loops are the same for every set of effects, and compiled once.
#pragma once

#include <concepts>

#include "core/kernel/methods/guided.h"
#include "cpu/ray_batch.h"

namespace pl {

/// Paths that are extended together: few enough for the innermost cache.
inline constexpr std::uint32_t kGuidedBlock = 64;

/// A guided method that is told what serves the surface where arrive() is called next, or nullptr: then it looks itself.
template <std::derived_from<GuidedSampling> M>
struct LookedUpAhead : M {
    const FoundVolume* found = nullptr;

    GuidedVertex arrive(const SurfacePoint& surface, MethodCounters& counters) const {
        return found != nullptr ? GuidedSampling::vertex_of(*found, counters) : M::arrive(surface, counters);
    }
};

/// What serves the ends of at most kGuidedBlock rays.
class LookupsAhead {
public:
    /// Rays from `first` to `end`: asks for the cells. Rays that hit nothing, or nothing that reflects, are left out.
    void begin(const SceneView& scene, const TableField& field, const RayBatch& rays, std::uint32_t first,
               std::uint32_t end);
    /// Finds the volumes. Best called after other work, when the cells have come.
    void finish(const TableField& field);
    /// Where a ray ends that hits something.
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
