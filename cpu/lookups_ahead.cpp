#include "cpu/lookups_ahead.h"

namespace pl {
namespace {

/// Of the surface, only what lookups need: the same for all effects.
PL_INLINE SurfacePoint surface_of(const SceneView& scene, const RayBatch& rays, std::uint32_t i) {
    return make_surface_point<FeatureSet{}>(scene, rays.hit(i), -rays.ray(i).direction);
}

PL_INLINE void ask_for_nodes(const FieldView& field, VolumePlace place) {
    if (place.kind() == VolumePlace::Kind::Node) __builtin_prefetch(field.tree.nodes.data + place.number());
    if (place.kind() != VolumePlace::Kind::Cell) return;
    const VolumeCell cell = field.grid.cells[place.number()];
    if (cell.has_nodes())
        for (int i = 0; i < VolumeCell::kMostNodes; ++i) __builtin_prefetch(&field.tree.nodes[cell.node(i)]);
    else if (cell.has_list())
        __builtin_prefetch(&field.grid.lists[cell.first_of_list()]);
}

}  // namespace

void LookupsAhead::place(const SceneView& scene, const FieldView& field, const RayBatch& rays, std::uint32_t ray) {
    if (!rays.hit(ray).found()) return;
    const SurfacePoint point = surface_of(scene, rays, ray);
    if (!scene.materials[point.material].reflects()) return;
    VolumePlace place{VolumePlace::Kind::Search, 0};
    if (field.tree.lookup == Lookup::Grid) place = field.grid.place_of(point.primitive, point.front, point.position);
    if (place.kind() == VolumePlace::Kind::Cell) __builtin_prefetch(&field.grid.cells[place.number()]);
    pending_[count_++] = {point.position, place, ray};
}

void LookupsAhead::begin(const SceneView& scene, const FieldView& field, const RayBatch& rays, std::uint32_t first,
                         std::uint32_t end) {
    first_ = first;
    count_ = 0;
    known_ = 0;
    for (std::uint32_t i = first; i < end; ++i) place(scene, field, rays, i);
}

void LookupsAhead::finish(const SceneView& scene, const FieldView& field, const RayBatch& rays) {
    for (std::uint32_t k = 0; k < count_; ++k) ask_for_nodes(field, pending_[k].place);
    for (std::uint32_t k = 0; k < count_; ++k) {
        const Pending& at = pending_[k];
        const GridAnswer answer = volume_at_place(field.tree, field.grid, at.place, at.position);
        found_[at.ray - first_] = answer.is_known ? answer.found : field.find(surface_of(scene, rays, at.ray));
        known_ |= std::uint64_t{1} << (at.ray - first_);
    }
}

}  // namespace pl
