#include "core/session/placement.h"

#include "core/base/timer.h"
#include "core/fields/volume_grid.h"

namespace pl {

std::shared_ptr<const HostVolumes> Placement::with_grid(const RenderBackend& backend, const HostScene& scene,
                                                        HostVolumes volumes) {
    const int threads = backend.info().free_threads();
    volumes.grid = build_volume_grid(scene, volumes, threads, &surfaces(scene, threads));
    return std::make_shared<const HostVolumes>(std::move(volumes));
}

void Placement::ensure(RenderBackend& backend, const HostScene& scene, const FieldSettings& settings,
                       const Camera& camera) {
    if (volumes_) return;
    const Stopwatch watch;
    shape_ = make_field_shape(scene, settings);
    const int threads = backend.info().free_threads();
    HostVolumes placed = place_volumes({scene, surfaces(scene, threads), settings, &camera, threads});
    volumes_ = with_grid(backend, scene, std::move(placed));
    backend.upload_volumes(volumes_, shape_);
    seconds_ = watch.seconds();
}

void Placement::adopt(RenderBackend& backend, const HostScene& scene, HostVolumes volumes, const FieldShape& shape,
                      const Refinement& refinement) {
    const std::shared_ptr<const HostVolumes> adopted = with_grid(backend, scene, std::move(volumes));
    backend.upload_volumes(adopted, shape);
    volumes_ = adopted;
    shape_ = shape;
    refinement_ = refinement;
}

RefinedPlacement Placement::split(const RenderBackend& backend, const HostScene& scene, const FieldSettings& settings,
                                  const Camera& camera, HostField& learned, std::size_t most) {
    const int threads = backend.info().free_threads();
    const std::vector<std::uint32_t> split = volumes_to_split(field_view(shape_, *volumes_, learned), most, threads);
    return refine_placement({scene, surfaces(scene, threads), settings, &camera, threads},
                            placement_view(*volumes_, shape_.extent), split);
}

void Placement::refine(const RenderBackend& backend, const HostScene& scene, RefinedPlacement refined) {
    volumes_ = with_grid(backend, scene, std::move(refined.volumes));
    refinement_.added += static_cast<std::uint32_t>(refined.parents.size());
}

/// Found when first asked for.
const LitSurfaces& Placement::surfaces(const HostScene& scene, int threads) {
    if (!surfaces_) surfaces_ = std::make_shared<const LitSurfaces>(find_lit_surfaces(scene, threads));
    return *surfaces_;
}

void Placement::change_materials(const HostScene& scene, const FieldSettings& settings, bool is_same) {
    surfaces_.reset();
    if (!is_same) volumes_.reset();
    if (volumes_) shape_ = make_field_shape(scene, settings);
}

void Placement::undo_refinement() {
    if (refinement_.added > 0) volumes_.reset();
    refinement_ = {};
}

}  // namespace pl
