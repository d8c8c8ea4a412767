// The part of Session that takes its state out for checkpoints, and puts it back.
#include "core/session/session_state.h"

#include "core/base/error.h"
#include "core/scene/scene_hash.h"
#include "core/session/exact_backend.h"
#include "core/session/session.h"
#include "core/session/settings_text.h"

namespace pl {
namespace {

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

std::vector<std::pair<std::string, std::string>> Session::identity() const {
    std::vector<std::pair<std::string, std::string>> identity = settings_text(settings_);
    identity.emplace(identity.begin(), "back end", backend_->info().name);
    identity.emplace(identity.begin(), "scene hash", scene_hash(scene()));
    return identity;
}

SessionState Session::save_state() const {
    const ExactBackend& backend = exact(*backend_);
    SessionState state{.identity = identity(), .placement = {}, .fields = {}, .films = {}, .is_closed = {}};
    if (scene_.knows_whether_closed()) state.is_closed = scene_.is_closed();
    if (placement_.is_placed())
        state.placement = SavedPlacement{.settings = settings_.field,
                                         .shape = placement_.shape(),
                                         .refinement = placement_.refinement(),
                                         .seconds = placement_.seconds(),
                                         .volumes = placement_.volumes()};
    for (const MethodInfo& method : all_methods()) {
        const bool has_tables = placement_.is_placed() && backend.has_field(method.id);
        if (!has_tables && field(method.id) == FieldProgress{}) continue;
        state.fields.push_back({.method = method.id,
                                .progress = field(method.id),
                                .arrays = has_tables ? backend.download_field(method.id) : HostField{}});
    }
    for (const MethodInfo& method : all_methods())
        for (const ViewInfo& view : all_views()) save_film({method.id, view.id}, state);
    return state;
}

std::uint64_t Session::state_bytes() const {
    std::uint64_t bytes = placement_.is_placed() ? volume_bytes(*placement_.volumes()) : 0;
    for (const MethodInfo& method : all_methods()) {
        bytes += backend_->field_report(method.id).bytes;
        for (const ViewInfo& view : all_views())
            bytes += films_[{method.id, view.id}].is_allocated ? pixel_count() * sizeof(FilmPixel) : 0;
    }
    return bytes;
}

void Session::save_film(FilmSlot slot, SessionState& state) const {
    const FilmProgress& progress = films_[slot];
    if (progress.origin.number == 0 && !progress.is_allocated) return;
    SavedFilm& film = state.films.emplace_back();
    film.slot = slot;
    film.progress = progress;
    if (!progress.is_allocated) return;
    film.pixels.resize(pixel_count());
    exact(*backend_).read_pixels(slot, 0, film.pixels);
}

void Session::restore_state(SessionState state) {
    require_same(identity(), state.identity);
    require_fit(state, *scene_.packed(), pixel_count());
    ExactBackend& backend = exact(*backend_);
    if (state.placement) {
        SavedPlacement& placed = *state.placement;
        placement_.adopt(backend, *scene_.packed(), *placed.volumes, placed.shape, placed.refinement);
        placement_.set_seconds(placed.seconds);
    }
    for (SavedField& saved : state.fields) {
        if (field_bytes(saved.arrays) > 0) backend.upload_field(saved.method, std::move(saved.arrays));
        field(saved.method) = std::move(saved.progress);
    }
    for (SavedFilm& film : state.films) {
        if (!film.pixels.empty()) {
            backend.reset_film(film.slot, settings_.width, settings_.height);
            backend.write_pixels(film.slot, 0, film.pixels);
        }
        films_.restore(film.slot, std::move(film.progress));
    }
    if (state.is_closed) scene_.remember_whether_closed(*state.is_closed);
}

}  // namespace pl
