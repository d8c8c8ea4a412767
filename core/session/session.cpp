#include "core/session/session.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/timer.h"
#include "core/fields/place_volumes.h"
#include "core/kernel/integrator/holes.h"
#include "core/session/exact_backend.h"
#include "core/session/path_settings.h"
#include "core/session/settings.h"

namespace pl {
namespace {

/// A film that does not exist yet is black.
Snapshot with_pixels(Snapshot snapshot, FilmReading film) {
    snapshot.pixels = std::move(film.mean);
    snapshot.pixels.resize(film_pixels(snapshot.width, snapshot.height), Vec3f{0.0f});
    snapshot.halves = std::move(film.halves);
    return snapshot;
}

/// Throws Error(Input) with the first value that differs.
void require_same(const std::vector<std::pair<std::string, std::string>>& expected,
                  const std::vector<std::pair<std::string, std::string>>& got) {
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const bool has_name = i < got.size() && got[i].first == expected[i].first;
        if (has_name && got[i].second == expected[i].second) continue;
        throw Error(ErrorKind::Input, "the checkpoint is of another run: " + expected[i].first + ": expected " +
                                          expected[i].second + ", got " + (has_name ? got[i].second : "none"));
    }
}

/// Whether the parts of a state have the sizes of this session.
void require_fit(const SessionState& state, const HostScene& scene, std::size_t pixels) {
    bool fits = !state.placement || state.placement->shape.light_clusters == scene.light_clusters.size();
    for (const SavedFilm& film : state.films)
        fits = fits && film.pixels.size() == (film.progress.is_allocated ? pixels : 0) &&
               film.progress.next_pixel <= pixels;
    for (const SavedField& field : state.fields)
        fits = fits && (field_bytes(field.arrays) == 0 ||
                        (state.placement && representation_of(field.arrays) ==
                                                representation_of(state.placement->settings, field.method)));
    if (!fits) throw Error(ErrorKind::Input, "the checkpoint's films and volumes do not have the sizes of this run");
}

}  // namespace

Session::Session(std::shared_ptr<RenderBackend> backend, std::shared_ptr<const SceneDescription> scene,
                 const RenderSettings& settings, double load_seconds)
    : Session(std::move(backend), SessionScene(std::move(scene)), settings, std::make_shared<FilmNumbers>(),
              load_seconds) {}

Session::Session(const Session& other, std::shared_ptr<RenderBackend> backend, const RenderSettings& settings)
    : Session(std::move(backend), other.inputs_->scene, settings, other.films_->numbers(), other.load_seconds_) {}

Session::Session(std::shared_ptr<RenderBackend> backend, SessionScene scene, const RenderSettings& settings,
                 std::shared_ptr<FilmNumbers> numbers, double load_seconds)
    : inputs_(std::make_unique<RenderInputs>(RenderInputs{std::move(backend), settings, std::move(scene)})),
      fields_(std::make_unique<SessionFields>(*inputs_)),
      films_(std::make_unique<FilmRenderer>(*inputs_, *fields_, std::move(numbers))), load_seconds_(load_seconds) {
    upload_scene();
}

void Session::upload_scene() {
    const Stopwatch upload;
    inputs_->backend->upload_scene(inputs_->scene.packed());
    upload_seconds_ = upload.seconds();
}

void Session::apply(const SessionEdit& edit) {
    if (const auto* change = std::get_if<EditLearned>(&edit)) import_field(*change->field);
    if (const auto* change = std::get_if<EditBackend>(&edit)) switch_backend(*change);
    if (const auto* change = std::get_if<EditMaterial>(&edit)) change_material(*change);
    if (const auto* change = std::get_if<EditLearning>(&edit)) control_learning(*change);
    if (const auto* change = std::get_if<EditForgetVolume>(&edit))
        fields_->forget_volume(*change, films_->progress({change->method, View::Beauty}).is_under_way());
    const Invalidation clear = take_over(edit, inputs_->settings);
    if (clear.films) films_->clear();
    if (clear.tables) clear_tables();
    if (clear.volumes) fields_->clear_volumes();
    if (!clear.scene) return;
    inputs_->scene = SessionScene(std::get<EditScene>(edit).scene);
    upload_scene();
}

void Session::clear_tables() {
    films_->forget_guiding();
    fields_->clear_tables();
}

/// Everything is replaced only after the changed scene is complete: a refused material or a failing back end changes
/// nothing.
void Session::change_material(const EditMaterial& edit) {
    SessionScene changed = inputs_->scene.with_material(edit.index, edit.material);
    inputs_->backend->upload_scene(changed.packed());
    const bool is_same = same_placement(*inputs_->scene.packed(), *changed.packed());
    inputs_->scene = std::move(changed);
    fields_->change_materials(is_same);
}

/// The new back end receives everything before it replaces the old one, so that a failure changes nothing. Its parked
/// films are dropped then, because its contents are unknown.
void Session::switch_backend(const EditBackend& edit) {
    if (edit.backend == inputs_->backend) return;
    std::vector<std::pair<MethodId, HostField>> learned;
    if (!edit.abandon_old) learned = fields_->download();
    const ParkedBackend next = films_->unpark(edit.backend);
    const Stopwatch upload;
    if (next.scene != inputs_->scene.packed()) next.backend->upload_scene(inputs_->scene.packed());
    fields_->upload(*next.backend, std::move(learned));
    upload_seconds_ = upload.seconds();
    films_->switch_to(next, !edit.abandon_old && !edit.forget_old);
    inputs_->backend = next.backend;
}

void Session::control_learning(const EditLearning& edit) {
    const FilmProgress& film = films_->progress({edit.method, View::Beauty});
    inputs_->settings.learn_passes = fields_->control_learning(edit, film.is_under_way(), film.trains);
}

void Session::import_field(LearnedField learned) {
    const FieldSettings settings = learned.settings;
    fields_->import_field(std::move(learned));
    inputs_->settings.field = settings;
    films_->clear();
    films_->forget_guiding();
}

ServedKernel Session::served_kernel(FilmSlot slot) const {
    return pl::served_kernel(backend().name, needed_features(slot), settings_for(slot));
}

Clocks Session::clocks(FilmSlot slot) const {
    const ViewInfo& view = info_of(slot.view);
    const FilmProgress& film = films_->progress(slot);
    const bool needs_volumes = info_of(slot.method).uses_field || view.needs_volumes || view.needs_tables;
    return {.load = load_seconds_,
            .build = inputs_->scene.build_seconds(),
            .upload = upload_seconds_,
            .place = needs_volumes ? fields_->placement().seconds() : 0.0,
            .precompute = fields_->progress(slot.method).precompute_seconds,
            .learn = film.learn_seconds,
            .render = film.render_seconds};
}

Snapshot Session::summary(FilmSlot slot) const {
    const FilmProgress& film = films_->progress(slot);
    return {.slot = slot,
            .width = settings().width,
            .height = settings().height,
            .pixels = {},
            .halves = {},
            .passes = film.passes,
            .warm = film.origin.warm,
            .counters = film.counters,
            .is_closed = films_->is_closed(),
            .clocks = clocks(slot),
            .field = field_status(slot.method),
            .guiding = guiding_status(slot),
            .bins = fields_->placement().bins(),
            .camera = settings().camera,
            .kernel = served_kernel(slot).name};
}

Snapshot Session::snapshot(FilmSlot slot) const { return with_pixels(summary(slot), films_->read(slot)); }

Snapshot Session::snapshot_with_halves(FilmSlot slot) const {
    return with_pixels(summary(slot), films_->read_halves(slot));
}

PassReplay Session::pass_replay(FilmSlot slot) const {
    if (slot.view != View::Beauty)
        throw Error(ErrorKind::Usage,
                    "view '" + std::string(info_of(slot.view).name) + "' has no paths to diagnose: show 'beauty'");
    const FilmProgress& film = films_->progress(slot);
    const Placement& placement = fields_->placement();
    PassReplay replay{.width = settings().width,
                      .height = settings().height,
                      .schedule = films_->schedule(slot),
                      .samples = film.passes,
                      .next_pixel = film.next_pixel,
                      .scene = packed_scene(),
                      .path = path_settings(settings(), slot.method),
                      .camera = inputs_->camera(),
                      .is_closed = films_->is_closed()};
    if (!film.runs.empty()) replay.runs = film.runs;
    if (film.counters.invalid_samples > 0) replay.invalid = inputs_->backend->invalid_samples(slot);
    const bool has_field =
        info_of(slot.method).uses_field && placement.is_placed() && inputs_->backend->has_field(slot.method);
    if (!has_field) return replay;  // or nothing is rendered yet
    if (info_of(slot.method).learns) {
        replay.has_moving_tables = true;
        replay.repeats_training = settings().field.learning.target == LearningTarget::ExpectedSarsa;
    }
    replay.volumes = placement.volumes();
    replay.shape = placement.shape();
    replay.field = inputs_->backend->download_field(slot.method);
    replay.mixture = mixture_of(settings(), slot.method);
    replay.learning = settings().field.learning;
    replay.unguided_path = path_settings(settings(), baseline_method());
    return replay;
}

std::int32_t Session::find_volume_at(Vec3f position, Vec3f normal) {
    fields_->ensure_volumes();
    return find_volume({.nodes = view_of(fields_->placement().volumes()->kd_nodes)}, position, normal);
}

std::optional<PickedPoint> Session::pick(Vec2f film_point) {
    const SceneView scene = inputs_->scene.packed()->view();
    const Ray ray = generate_ray(inputs_->camera(), film_point,
                                 {static_cast<float>(settings().width), static_cast<float>(settings().height)});
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

std::vector<std::pair<std::string, std::string>> Session::identity() const {
    std::vector<std::pair<std::string, std::string>> identity = settings_text(settings());
    identity.emplace(identity.begin(), "back end", backend().name);
    identity.emplace(identity.begin(), "scene hash", scene_hash());
    return identity;
}

SessionState Session::save_state() const {
    exact(*inputs_->backend);
    SessionState state{.identity = identity(), .placement = {}, .fields = {}, .films = {}, .is_closed = {}};
    fields_->save_state(state);
    films_->save_state(state);
    return state;
}

void Session::restore_state(SessionState state) {
    require_same(identity(), state.identity);
    require_fit(state, *packed_scene(), inputs_->pixel_count());
    exact(*inputs_->backend);
    fields_->restore_state(state);
    films_->restore_state(state);
}

}  // namespace pl
