#include "core/session/session.h"

#include "core/base/error.h"
#include "core/base/timer.h"
#include "core/fields/volume_grid.h"
#include "core/kernel/integrator/holes.h"
#include "core/scene/needed_effects.h"
#include "core/scene/pack_scene.h"
#include "core/scene/scene_hash.h"

namespace pl {

Session::Session(std::shared_ptr<RenderBackend> backend, std::shared_ptr<const SceneDescription> scene,
                 const RenderSettings& settings, double load_seconds)
    : backend_(std::move(backend)), scene_(std::move(scene)), settings_(settings), load_seconds_(load_seconds) {
    load_scene();
}

void Session::load_scene() {
    const Stopwatch build;
    packed_ = std::make_shared<const HostScene>(pack_scene(*scene_));
    enclosure_.reset();
    build_seconds_ = build.seconds();
    const Stopwatch upload;
    backend_->upload_scene(packed_);
    upload_seconds_ = upload.seconds();
}

void Session::ensure_volumes() {
    if (volumes_) return;
    const Stopwatch watch;
    shape_ = make_field_shape(*packed_, settings_.field);
    volumes_ = with_lookup(place_volumes(*packed_, settings_.field), shape_.lookup);
    backend_->upload_volumes(volumes_, shape_);
    place_seconds_ = watch.seconds();
}

/// The volumes with what the chosen lookup needs besides the tree.
std::shared_ptr<const HostVolumes> Session::with_lookup(HostVolumes volumes, Lookup lookup) const {
    volumes.grid = {};
    if (lookup == Lookup::Grid) volumes.grid = build_volume_grid(*packed_, volumes, backend_->info().threads);
    return std::make_shared<const HostVolumes>(std::move(volumes));
}

void Session::ensure_tables() {
    ensure_volumes();
    const MethodId owner = field_owner(settings_.method);
    if (!backend_->has_field(owner)) backend_->upload_field(owner, make_field(shape_, volumes_->normals.size()));
}

void Session::ensure_film(FilmSlot slot) {
    FilmState& state = films_[static_cast<std::size_t>(slot.index())];
    if (state.allocated) return;
    backend_->reset_film(slot, settings_.width, settings_.height);
    state = FilmState{.origin = state.origin};
    state.allocated = true;
}

/// Notes what there was before the first piece of work on a film, be it precomputation.
void Session::begin_film(FilmSlot slot) {
    FilmOrigin& origin = films_[static_cast<std::size_t>(slot.index())].origin;
    if (origin.number != 0) return;
    const FieldProgress& learned = fields_[static_cast<std::size_t>(slot.method)];
    origin = {.number = ++films_begun_,
              .generation = film_generation_,
              .warm =
                  learned.passes > 0 || learned.has_part || learned.precomputed_slices > 0 || learned.next_probe > 0,
              .place_seconds = volumes_ ? place_seconds_ : 0.0,
              .precompute_seconds = learned.precompute_seconds};
}

FeatureSet Session::needed_features() const { return pl::needed_features(*packed_, settings_); }

ServedKernel Session::served_kernel() const { return pl::served_kernel(backend_->info().name, *packed_, settings_); }

std::optional<FieldStatus> Session::field_status() const {
    if (!volumes_ || !info_of(settings_.method).uses_field) return std::nullopt;
    const FieldProgress& state = field();
    FieldStatus status{.volumes = static_cast<int>(volumes_->normals.size()),
                       .added_volumes = static_cast<int>(refinement_.added),
                       .bins = shape_.cells.count(),
                       .bytes =
                           volume_bytes(*volumes_) + volumes_->normals.size() * table_bytes(shape_.cells.count()),
                       .passes = state.passes,
                       .records = state.records,
                       .clamped_records = state.clamped_records,
                       .lookup_misses = state.lookup_misses,
                       .precomputed_share = 1.0};
    if (settings_.method == MethodId::Precomputed)
        status.precomputed_share = static_cast<double>(state.precomputed_slices) / settings_.field.precompute_samples;
    return status;
}

Clocks Session::clocks() const {
    const ViewInfo& view = info_of(settings_.view);
    const bool needs_volumes = info_of(settings_.method).uses_field || view.needs_volumes || view.needs_tables;
    return {.load = load_seconds_,
            .build = build_seconds_,
            .upload = upload_seconds_,
            .place = volumes_ && needs_volumes ? place_seconds_ : 0.0,
            .precompute = field().precompute_seconds,
            .learn = film().learn_seconds,
            .render = film().render_seconds};
}

Snapshot Session::summary() const {
    const FilmState& state = film();
    return {.slot = slot(),
            .width = settings_.width,
            .height = settings_.height,
            .pixels = {},
            .halves = {},
            .passes = state.passes,
            .counters = state.counters,
            .is_closed = is_closed_.value_or(false),
            .clocks = clocks(),
            .field = field_status(),
            .bins = volumes_ ? shape_.cells.count() : 0,
            .camera = settings_.camera,
            .kernel = served_kernel().name};
}

Snapshot Session::snapshot() const {
    Snapshot result = summary();
    take_pixels(result, film().allocated ? backend_->read_film(slot()) : FilmReading{});
    return result;
}

Snapshot Session::snapshot_with_halves() const {
    Snapshot result = summary();
    take_pixels(result, film().allocated ? backend_->read_halves(slot()) : FilmReading{});
    return result;
}

/// A film that is not there yet is black.
void Session::take_pixels(Snapshot& snapshot, FilmReading film) const {
    snapshot.pixels = std::move(film.mean);
    snapshot.pixels.resize(film_pixels(settings_.width, settings_.height), Vec3f{0.0f});
    snapshot.halves = std::move(film.halves);
}

ShownFilm Session::show_film(const DisplaySettings& display) {
    ensure_film(slot());
    const View view = settings_.view;
    const int bins = volumes_ ? shape_.cells.count() : 0;
    const ShownRange range = shown_range(view, bins, ends_at_largest(view) ? backend_->largest_value(slot()) : 0.0f);
    return {backend_->show_film(slot(), frame_style(view, display, range)), range};
}

VolumeInspection Session::inspect_volume(std::int32_t volume) const {
    const MethodId owner = field_owner(settings_.method);
    if (!volumes_ || !backend_->has_field(owner))
        throw Error(ErrorKind::Usage, "nothing has been learned yet: render with a method that uses radiance volumes "
                                      "(precomputed, reinforcement) first");
    if (volume < 0 || static_cast<std::size_t>(volume) >= volumes_->normals.size())
        throw Error(ErrorKind::Usage, "radiance volume " + std::to_string(volume) +
                                          " does not exist: expected 0 to " +
                                          std::to_string(volumes_->normals.size()) + " (exclusive)");
    HostTables tables = tables_of(backend_->download_field(owner));
    const TableField field = table_field(shape_, *volumes_, tables);
    const auto index = static_cast<std::size_t>(volume);
    const auto cells = static_cast<std::size_t>(shape_.cells.count());
    const auto first = static_cast<std::ptrdiff_t>(index * cells);
    const auto last = first + static_cast<std::ptrdiff_t>(cells);

    VolumeInspection result{.volume = volume,
                            .position = volumes_->sites[index].position,
                            .normal = volumes_->normals[index],
                            .side = shape_.cells.side,
                            .radiance = {tables.radiance.begin() + first, tables.radiance.begin() + last},
                            .probability = {},
                            .visits = {tables.visits.begin() + first, tables.visits.begin() + last},
                            .mean_radiance = tables.mean_radiance[index]};
    const DirectionTable table(field, volume);
    for (int row = 0; row < shape_.cells.side; ++row)
        for (int column = 0; column < shape_.cells.side; ++column)
            result.probability.push_back(table.cell_probability(column, row));
    return result;
}

LearnedField Session::export_field() const {
    const MethodId method = settings_.method;
    if (!volumes_ || !backend_->has_field(method))
        throw Error(ErrorKind::Usage, "method '" + std::string(info_of(method).name) + "' has learned nothing yet");
    return {.method = method,
            .scene_hash = scene_hash(*scene_),
            .settings = settings_.field,
            .shape = shape_,
            .volumes = volumes_,
            .refinement = refinement_,
            .field = backend_->download_field(method),
            .progress = field().without_part()};
}

std::int32_t Session::find_volume_at(Vec3f position, Vec3f normal) {
    ensure_volumes();
    return find_volume({.nodes = view_of(volumes_->kd_nodes)}, position, normal);
}

std::optional<PickedPoint> Session::pick(Vec2f film_point) {
    const SceneView scene = packed_->view();
    const Camera camera = make_camera(settings_.camera, settings_.width, settings_.height);
    const Ray ray =
        generate_ray(camera, film_point, {static_cast<float>(settings_.width), static_cast<float>(settings_.height)});
    const Hit hit = closest_solid_hit<kEveryFeature>(scene, BvhIntersector{scene}, ray);
    if (!hit.found()) return std::nullopt;
    const auto surface = make_surface_point<FeatureSet{}>(scene, hit, -ray.direction);
    return PickedPoint{.position = surface.position,
                       .normal = surface.geometric_normal,
                       .primitive = surface.primitive,
                       .material = surface.material,
                       .distance = hit.t,
                       .volume = find_volume_at(surface.position, surface.geometric_normal)};
}

}  // namespace pl
