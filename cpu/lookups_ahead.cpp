#include "cpu/lookups_ahead.h"

#include <new>

namespace pl {
namespace {

void prefetch_nodes(const PlacementView& placement, VolumePlace place) {
    if (place.kind() == VolumePlace::Kind::Node) __builtin_prefetch(placement.tree.nodes.data + place.number());
    if (place.kind() != VolumePlace::Kind::Cell) return;
    const VolumeCell cell = placement.grid.cells[place.number()];
    if (cell.has_nodes())
        for (int i = 0; i < VolumeCell::kMostNodes; ++i) __builtin_prefetch(&placement.tree.nodes[cell.node(i)]);
    else if (cell.has_list())
        __builtin_prefetch(&placement.grid.lists[cell.first_of_list()]);
}

}  // namespace

void LookupsAhead::begin(const SceneView& scene, const PlacementView& placement, const RayBatch& rays,
                         std::uint32_t first, std::uint32_t end) {
    first_ = first;
    count_ = 0;
    known_ = 0;
    const bool has_grid = placement.tree.lookup == Lookup::Grid;
    for (std::uint32_t i = first; i < end; ++i) {
        const Hit hit = rays.hit(i);
        if (!hit.found()) continue;
        // Constructed in place: the wide loads of a copy would stall, since narrower stores do not forward to them.
        const SurfacePoint& point = *::new (static_cast<void*>(&points_[i - first]))
                                        SurfacePoint(make_flat_point(scene, hit, -rays.ray(i).direction));
        if (!scene.materials[point.material].reflects()) continue;
        VolumePlace place{VolumePlace::Kind::Search, 0};
        if (has_grid) place = placement.grid.place_of(point.primitive, point.front, point.position);
        if (place.kind() == VolumePlace::Kind::Cell) __builtin_prefetch(&placement.grid.cells[place.number()]);
        pending_[count_++] = {place, i};
    }
}

void LookupsAhead::finish(const PlacementView& placement) {
    for (std::uint32_t k = 0; k < count_; ++k) prefetch_nodes(placement, pending_[k].place);
    for (std::uint32_t k = 0; k < count_; ++k) {
        const Pending& at = pending_[k];
        const SurfacePoint& point = points_[at.ray - first_];
        const GridAnswer answer = volume_at_place(placement.tree, placement.grid, at.place, point.position);
        found_[at.ray - first_] = answer.is_known ? answer.found : placement.find(point);
        known_ |= std::uint64_t{1} << (at.ray - first_);
    }
}

}  // namespace pl
