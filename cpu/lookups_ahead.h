// The volumes that serve a block of paths, found before the paths arrive there: one after the other in a loop of their own
// lookups overlap, and each step asks for the memory of the next one. Cells are larger than the innermost caches.
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
    void begin(const SceneView& scene, const FieldView& field, const RayBatch& rays, std::uint32_t first,
               std::uint32_t end) {
        first_ = first;
        count_ = 0;
        known_ = 0;
        for (std::uint32_t i = first; i < end; ++i) place(scene, field, rays, i);
    }
    /// Finds the volumes. Best called after other work, when the cells have come.
    void finish(const SceneView& scene, const FieldView& field, const RayBatch& rays) {
        for (std::uint32_t k = 0; k < count_; ++k) ask_for_nodes(field, pending_[k].place);
        for (std::uint32_t k = 0; k < count_; ++k) {
            const Pending& at = pending_[k];
            const GridAnswer answer = volume_at_place(field.tree, field.grid, at.place, at.position);
            found_[at.ray - first_] = answer.is_known ? answer.found : field.find(surface_of(scene, rays, at.ray));
            known_ |= std::uint64_t{1} << (at.ray - first_);
        }
    }
    /// nullptr for rays that were left out.
    const FoundVolume* found(std::uint32_t ray) const {
        return ((known_ >> (ray - first_)) & 1u) != 0 ? &found_[ray - first_] : nullptr;
    }

private:
    struct Pending {
        Vec3f position;
        VolumePlace place;
        std::uint32_t ray;
    };

    /// Of the surface, only what lookups need: the same for all effects.
    static PL_INLINE SurfacePoint surface_of(const SceneView& scene, const RayBatch& rays, std::uint32_t i) {
        return make_surface_point<FeatureSet{}>(scene, rays.hit(i), -rays.ray(i).direction);
    }

    PL_INLINE void place(const SceneView& scene, const FieldView& field, const RayBatch& rays, std::uint32_t ray) {
        if (!rays.hit(ray).found()) return;
        const SurfacePoint point = surface_of(scene, rays, ray);
        if (!scene.materials[point.material].reflects()) return;
        VolumePlace place{VolumePlace::Kind::Search, 0};
        if (field.tree.lookup == Lookup::Grid)
            place = field.grid.place_of(point.primitive, point.front, point.position);
        if (place.kind() == VolumePlace::Kind::Cell) __builtin_prefetch(&field.grid.cells[place.number()]);
        pending_[count_++] = {point.position, place, ray};
    }

    static PL_INLINE void ask_for_nodes(const FieldView& field, VolumePlace place) {
        if (place.kind() == VolumePlace::Kind::Node) __builtin_prefetch(field.tree.nodes.data + place.number());
        if (place.kind() != VolumePlace::Kind::Cell) return;
        const VolumeCell cell = field.grid.cells[place.number()];
        if (cell.has_nodes())
            for (int i = 0; i < VolumeCell::kMostNodes; ++i) __builtin_prefetch(&field.tree.nodes[cell.node(i)]);
        else if (cell.has_list())
            __builtin_prefetch(&field.grid.lists[cell.first_of_list()]);
    }

    std::uint32_t first_ = 0;
    std::uint32_t count_ = 0;
    std::uint64_t known_ = 0;  ///< one bit per ray
    static_assert(kGuidedBlock <= 64);
    Pending pending_[kGuidedBlock];
    FoundVolume found_[kGuidedBlock];
};

}  // namespace pl
