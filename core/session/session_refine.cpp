// The part of Session that refines the placement of volumes while a method learns.
#include <utility>

#include "core/session/refinement_schedule.h"
#include "core/session/session.h"

namespace pl {

/// At most one round per update.
void Session::refine_if_due(MethodId method) {
    const auto added = volumes_to_add(settings_.field, placement_.count(), placement_.refinement(), field(method),
                                      placement_.shape().light_clusters);
    if (!added) return;
    if (*added > 0) split_volumes(method, *added);
    placement_.count_round();
}

/// Splits volumes by the tables of the learning method.
void Session::split_volumes(MethodId method, std::size_t most) {
    HostField learned = backend_->download_field(method);
    const FieldShape& shape = placement_.shape();
    const HostVolumes& volumes = *placement_.volumes();
    const int threads = backend_->info().free_threads();
    const std::vector<std::uint32_t> split = volumes_to_split(field_view(shape, volumes, learned), most, threads);
    const Camera camera = view_camera();
    const HostScene& scene = *scene_.packed();
    RefinedPlacement refined =
        refine_placement({scene, placement_.surfaces(scene, threads), settings_.field, &camera, threads},
                         placement_view(volumes, shape.extent), split);
    if (!refined.parents.empty()) replace_volumes(method, std::move(refined), std::move(learned));
}

/// The films stay: tables only guide the sampling. A complete radiance map keeps the measured tables of the parents;
/// an incomplete one begins anew, since its slices are counted for all volumes at once.
void Session::replace_volumes(MethodId learner, RefinedPlacement refined, HostField learned) {
    const FieldShape& shape = placement_.shape();
    std::vector<std::pair<MethodId, HostField>> tables;
    tables.emplace_back(learner, split_field(shape, std::move(learned), refined.parents));
    for (const MethodInfo& other : all_methods()) {
        if (other.id == learner || !backend_->has_field(other.id)) continue;
        FieldProgress& progress = field(other.id);
        ++progress.updates;
        if (progress.passes > 0)
            tables.emplace_back(other.id, split_field(shape, backend_->download_field(other.id), refined.parents));
        else
            progress = {.updates = progress.updates, .precompute_seconds = progress.precompute_seconds};
    }
    placement_.refine(*backend_, *scene_.packed(), std::move(refined));
    try {
        backend_->upload_volumes(placement_.volumes(), placement_.shape());
        for (auto& [method, table] : tables) backend_->upload_field(method, std::move(table));
    } catch (...) {  // the contents of the back end are unknown
        placement_.clear();
        clear_tables();
        clear_films();
        throw;
    }
    films_.clear(View::Voronoi);  // its passes would mix the cells of both placements
}

}  // namespace pl
