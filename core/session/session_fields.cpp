// The part of Session that exports and imports learned fields.
#include "core/base/error.h"
#include "core/scene/scene_hash.h"
#include "core/session/path_settings.h"
#include "core/session/session.h"

namespace pl {
namespace {

/// Whether the lengths of all arrays agree with each other and with the scene.
bool fits_together(const LearnedField& field, const HostScene& scene) {
    if (field.volumes == nullptr || field.shape.cells.side < 1) return false;
    if (field.shape.light_clusters != scene.light_clusters.size()) return false;
    const std::size_t volumes = field.volumes->normals.size();
    return field.volumes->sites.size() == volumes && field.volumes->kd_nodes.size() <= volumes &&
           field.refinement.added <= volumes &&
           representation_of(field.field) == representation_of(field.settings, field.method) &&
           fits(field.shape, field.field, volumes);
}

}  // namespace

void Session::ensure_tables(MethodId method) {
    const MethodId owner = field_owner(method);
    if (!backend_->has_field(owner)) require_field_memory(settings_.field, scene_.packed()->light_clusters.size());
    ensure_volumes();
    if (!backend_->has_field(owner))
        backend_->upload_field(
            owner, make_field(placement_.shape(), placement_.count(), representation_of(settings_.field, owner)));
}

void Session::clear_tables() {
    fields_.fill(FieldProgress{});
    films_.forget_guiding();
    placement_.undo_refinement();
    if (placement_.is_placed()) backend_->upload_volumes(placement_.volumes(), placement_.shape());
}

VolumeInspection Session::inspect_volume(MethodId method, std::int32_t volume) const {
    const MethodId owner = field_owner(method);
    if (!placement_.is_placed() || !backend_->has_field(owner))
        throw Error(ErrorKind::Usage, "nothing has been learned yet: render with a method that uses radiance volumes "
                                      "(precomputed, reinforcement) first");
    if (volume < 0 || static_cast<std::size_t>(volume) >= placement_.count())
        throw Error(ErrorKind::Usage, "radiance volume " + std::to_string(volume) +
                                          " does not exist: expected 0 to " + std::to_string(placement_.count()) +
                                          " (exclusive)");
    HostField field = backend_->download_field(owner);
    VolumeInspection inspection =
        pl::inspect_volume(field_view(placement_.shape(), *placement_.volumes(), field), volume);
    const MixtureSettings mixture = mixture_of(settings_, owner);
    if (mixture.learned == 0) inspection.bsdf_fraction = mixture.bsdf_fraction;
    return inspection;
}

LearnedField Session::export_field(MethodId method) const {
    if (!placement_.is_placed() || !backend_->has_field(method))
        throw Error(ErrorKind::Usage, "method '" + std::string(info_of(method).name) + "' has learned nothing yet");
    return {.method = method,
            .scene_hash = scene_hash(scene()),
            .settings = settings_.field,
            .shape = placement_.shape(),
            .volumes = placement_.volumes(),
            .refinement = placement_.refinement(),
            .field = backend_->download_field(method),
            .progress = field(method).without_part()};
}

void Session::import_field(LearnedField learned) {
    require_learned_in(scene(), learned);
    if (!info_of(learned.method).uses_field || !fits_together(learned, *scene_.packed()))
        throw Error(ErrorKind::Input, "the field's volumes and tables do not fit together");
    Placement adopted = placement_;
    adopted.adopt(*backend_, *scene_.packed(), *learned.volumes, learned.shape, learned.refinement);
    backend_->upload_field(learned.method, std::move(learned.field));
    placement_ = std::move(adopted);
    settings_.field = learned.settings;
    fields_.fill(FieldProgress{});
    field(learned.method) = learned.progress;
    clear_films();
    films_.forget_guiding();
}

}  // namespace pl
