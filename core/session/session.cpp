#include "core/session/session.h"

#include "core/base/timer.h"
#include "core/kernel/integrator/holes.h"
#include "core/scene/pack_scene.h"

namespace pl {

Session::Session(std::shared_ptr<RenderBackend> backend, std::shared_ptr<const SceneDescription> scene,
                 const RenderSettings& settings, double load_seconds)
    : backend_(std::move(backend)), settings_(settings), scene_(std::move(scene)), load_seconds_(load_seconds) {
    upload_scene();
}

void Session::replace_scene(const EditScene& edit) {
    scene_ = SessionScene(edit.scene);
    upload_scene();
}

void Session::upload_scene() {
    const Stopwatch upload;
    backend_->upload_scene(scene_.packed());
    upload_seconds_ = upload.seconds();
}

RenderSettings Session::settings_for(FilmSlot slot) const {
    RenderSettings settings = settings_;
    settings.method = slot.method;
    settings.view = slot.view;
    return settings;
}

FeatureSet Session::needed_features(FilmSlot slot) const {
    return pl::needed_features(*scene_.packed(), settings_for(slot));
}

ServedKernel Session::served_kernel(FilmSlot slot) const {
    return pl::served_kernel(backend_->info().name, *scene_.packed(), settings_for(slot));
}

/// The back end is asked only if nothing follows from the shape, since it may have to wait for a device.
FieldReport Session::field_report(MethodId method) const {
    const auto report =
        report_by_shape(placement_.shape(), placement_.count(), representation_of(settings_.field, method));
    return report ? *report : backend_->field_report(method);
}

std::optional<FieldStatus> Session::field_status(MethodId method) const {
    if (!placement_.is_placed() || !info_of(method).uses_field) return std::nullopt;
    const FieldProgress& state = field(method);
    const FieldReport report = field_report(method);
    FieldStatus status{.volumes = static_cast<int>(placement_.count()),
                       .added_volumes = static_cast<int>(placement_.refinement().added),
                       .bins = placement_.bins(),
                       .representation = representation_of(settings_.field, method),
                       .bytes = volume_bytes(*placement_.volumes()) + report.bytes,
                       .network = report.network,
                       .passes = trained_passes(method),
                       .records = state.records,
                       .clamped_records = state.clamped_records,
                       .lookup_misses = state.lookup_misses,
                       .precomputed_share = 1.0,
                       .is_frozen = info_of(method).learns && is_frozen(method),
                       .was_edited = state.was_edited};
    if (info_of(method).precomputes)
        status.precomputed_share =
            (state.precomputed_slices + static_cast<double>(state.next_probe) / probe_count()) /
            settings_.field.precompute_samples;
    return status;
}

Clocks Session::clocks(FilmSlot slot) const {
    const ViewInfo& view = info_of(slot.view);
    const bool needs_volumes = info_of(slot.method).uses_field || view.needs_volumes || view.needs_tables;
    return {.load = load_seconds_,
            .build = scene_.build_seconds(),
            .upload = upload_seconds_,
            .place = needs_volumes ? placement_.seconds() : 0.0,
            .precompute = field(slot.method).precompute_seconds,
            .learn = films_[slot].learn_seconds,
            .render = films_[slot].render_seconds};
}

Snapshot Session::summary(FilmSlot slot) const {
    const FilmProgress& state = films_[slot];
    return {.slot = slot,
            .width = settings_.width,
            .height = settings_.height,
            .pixels = {},
            .halves = {},
            .passes = state.passes,
            .warm = state.origin.warm,
            .counters = state.counters,
            .is_closed = scene_.is_closed(),
            .clocks = clocks(slot),
            .field = field_status(slot.method),
            .guiding = guiding_status(slot),
            .bins = placement_.bins(),
            .camera = settings_.camera,
            .kernel = served_kernel(slot).name};
}

Snapshot Session::snapshot(FilmSlot slot) const {
    Snapshot result = summary(slot);
    take_pixels(result, films_[slot].is_allocated ? backend_->read_film(slot) : FilmReading{});
    return result;
}

Snapshot Session::snapshot_with_halves(FilmSlot slot) const {
    Snapshot result = summary(slot);
    take_pixels(result, films_[slot].is_allocated ? backend_->read_halves(slot) : FilmReading{});
    return result;
}

/// A film that does not exist yet is black.
void Session::take_pixels(Snapshot& snapshot, FilmReading film) const {
    snapshot.pixels = std::move(film.mean);
    snapshot.pixels.resize(film_pixels(settings_.width, settings_.height), Vec3f{0.0f});
    snapshot.halves = std::move(film.halves);
}

ShownFilm Session::show_film(FilmSlot slot, const DisplaySettings& display) {
    ensure_film(slot);
    const float largest = ends_at_largest(slot.view) ? backend_->largest_value(slot) : 0.0f;
    const ShownRange range = shown_range(slot.view, placement_.bins(), largest);
    return {backend_->show_film(slot, frame_style(slot.view, display, range)), range};
}

Camera Session::view_camera() const { return make_camera(settings_.camera, settings_.width, settings_.height); }

std::int32_t Session::find_volume_at(Vec3f position, Vec3f normal) {
    ensure_volumes();
    return find_volume({.nodes = view_of(placement_.volumes()->kd_nodes)}, position, normal);
}

std::optional<PickedPoint> Session::pick(Vec2f film_point) {
    const SceneView scene = scene_.packed()->view();
    const Camera camera = view_camera();
    const Ray ray =
        generate_ray(camera, film_point, {static_cast<float>(settings_.width), static_cast<float>(settings_.height)});
    const Hit hit = closest_solid_hit<kEveryFeature>(scene, BvhIntersector{scene}, ray);
    if (!hit.found()) return std::nullopt;
    const auto surface = make_surface_point<kPlaceFeatures>(scene, hit, -ray.direction);
    return PickedPoint{.position = surface.position,
                       .normal = surface.geometric_normal,
                       .primitive = surface.primitive,
                       .material = surface.material,
                       .distance = hit.t,
                       .volume = find_volume_at(surface.position, surface.geometric_normal)};
}

}  // namespace pl
