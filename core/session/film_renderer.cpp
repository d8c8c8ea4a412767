#include "core/session/film_renderer.h"

#include <algorithm>

#include "core/base/timer.h"
#include "core/session/exact_backend.h"
#include "core/session/path_settings.h"
#include "core/session/update_schedule.h"

namespace pl {
namespace {

bool learns_from(FilmSlot slot) { return slot.view == View::Beauty && info_of(slot.method).learns; }

bool is_power_of_two(std::uint32_t n) { return n != 0 && (n & (n - 1)) == 0; }

}  // namespace

Progress FilmRenderer::advance(FilmSlot slot, const StopFlag* stop, std::uint32_t most_passes) {
    prepare(slot);
    if (needs_precompute(slot)) return precompute(slot, stop);
    if (info_of(slot.view).needs_tables && info_of(slot.method).learns && !films_[slot].is_under_way()) {
        const FilmSlot teacher{slot.method, View::Beauty};
        begin(teacher);
        if (render_passes(teacher, stop, 1) == Progress::Stopped) return Progress::Stopped;
    }
    return render_passes(slot, stop, most_passes);
}

Progress FilmRenderer::advance_to_path(FilmSlot slot, std::uint32_t pixel, const StopFlag* stop) {
    prepare(slot);
    if (needs_precompute(slot)) return precompute(slot, stop);
    if (const auto instead = begin_pass(slot)) return *instead;
    return render_parts_before(slot, pixel, stop) ? Progress::Rendered : Progress::Stopped;
}

void FilmRenderer::prepare(FilmSlot slot) {
    begin(slot);
    ensure(slot);  // before the work for it: it may not fit the memory
    const ViewInfo& view = info_of(slot.view);
    if (view.needs_volumes) fields_.ensure_volumes();
    if (info_of(slot.method).uses_field || view.needs_tables) fields_.ensure_field(slot.method);
}

void FilmRenderer::begin(FilmSlot slot) {
    films_.begin(slot, {.warm = fields_.is_warm(slot.method),
                        .place_seconds = fields_.placement().seconds(),
                        .precompute_seconds = fields_.progress(slot.method).precompute_seconds});
}

void FilmRenderer::ensure(FilmSlot slot) {
    FilmProgress& film = films_[slot];
    if (film.is_allocated) return;
    reset(slot);
    film = FilmProgress{.origin = film.origin, .guiding = film.guiding};
    film.is_allocated = true;
    guiding_.begin_film(slot, film);
}

/// Decides about a pass that begins, and does nothing for a pass under way. Returns the progress to report in place of a pass, if any.
std::optional<Progress> FilmRenderer::begin_pass(FilmSlot slot) {
    ensure(slot);
    FilmProgress& film = films_[slot];
    if (film.is_under_way()) return std::nullopt;
    if (learns_from(slot)) fields_.begin_pass(slot.method);
    // The map shows a changing field: restarting at powers of two keeps at least half of the samples recent.
    if (slot.view == View::RadianceMap && is_power_of_two(film.passes)) reset(slot);
    guiding_.begin_pass(slot, film);
    if (needs_precompute(slot)) return Progress::Precomputed;  // by the choice just made
    begin_run_if_due(slot);
    return std::nullopt;
}

/// For a film that warms up the map stays coarse until guiding is chosen, and as long as it does not pay: its other probes take as long
/// as several passes.
bool FilmRenderer::needs_precompute(FilmSlot slot) const {
    const bool shows_field = slot.view == View::Beauty || info_of(slot.view).needs_tables;
    if (!shows_field || !info_of(slot.method).precomputes || fields_.is_map_complete(slot.method)) return false;
    return !guiding_.coarse_map_suffices(slot, films_[slot]) || !fields_.has_coarse_map(slot.method);
}

Progress FilmRenderer::precompute(FilmSlot slot, const StopFlag* stop) {
    const bool is_complete = fields_.precompute(slot, guiding_.coarse_map_suffices(slot, films_[slot]), stop);
    return is_complete ? Progress::Precomputed : Progress::Stopped;
}

/// The rest of a pass, in parts, or several whole passes.
Progress FilmRenderer::render_passes(FilmSlot slot, const StopFlag* stop, std::uint32_t most) {
    if (const auto instead = begin_pass(slot)) return *instead;
    const std::uint32_t pixels = inputs_.pixel_count();
    if (!render_parts_before(slot, pixels - 1, stop)) return Progress::Stopped;
    render_part(slot, pixels, stop, equal_passes(slot, most));
    FilmProgress& film = films_[slot];
    if (film.next_pixel < pixels) return Progress::Stopped;
    for (; film.next_pixel >= pixels; film.next_pixel -= pixels) finish_pass(slot);
    return Progress::Rendered;
}

/// Tables are trained by the members that passes have drawn, so after each of their changes passes that train draw from sequences of
/// their own. On the others nothing depends but the choice of guiding: while it stays they go on where the last of them ended.
void FilmRenderer::begin_run_if_due(FilmSlot slot) {
    FilmProgress& film = films_[slot];
    std::vector<PassRun>& runs = film.runs;
    if (slot.view != View::Beauty) return;
    PassRun next{.first_pass = film.passes,
                 .first_sample = schedule(slot).sample_of(film.passes),
                 .is_guided = film.is_guided,
                 .trains = film.trains,
                 .decides = guiding_.role_of(slot, film, film.passes) != PassRole::None};
    next.sequences = next.trains || next.decides ? next.own_sequences() : next.sequences_behind(runs);
    const std::uint64_t updates = fields_.progress(slot.method).updates;
    const bool goes_on = !runs.empty() && next.is_like(runs.back()) && (!next.trains || updates == film.updates_seen);
    if (goes_on || (!runs.empty() && runs.back().first_pass == film.passes))
        return;  // or it was stopped before its first path
    runs.push_back(next);
    film.updates_seen = updates;
}

/// A learner counts the passes of its field, since passes of its earlier pictures have trained the tables, see
/// FieldProgress::without_part().
PassSchedule FilmRenderer::schedule(FilmSlot slot) const {
    const FilmProgress& film = films_[slot];
    PassSchedule schedule = film.guiding.schedule();
    if (!learns_from(slot)) return schedule;
    const std::uint64_t passes = fields_.progress(slot.method).passes;
    schedule.trained = static_cast<std::uint32_t>(std::max(passes, std::uint64_t{film.passes}) - film.passes);
    schedule.first_sample = PassSchedule::kTrainingSamples + schedule.trained;
    schedule.ramp = weight_ramp(inputs_.settings, slot.method);
    return schedule;
}

/// The number of passes from the present one on, at most `most`, between which nothing changes but the number of the sample.
std::uint32_t FilmRenderer::equal_passes(FilmSlot slot, std::uint32_t most) const {
    const FilmProgress& film = films_[slot];
    if (slot.view != View::Beauty || film.is_under_way()) return 1;
    const bool learns = learns_from(slot) && film.is_guided && !fields_.is_frozen(slot.method);
    const std::uint64_t left = learns ? inputs_.settings.learn_passes - fields_.trained_passes(slot.method) : most;
    const PassSchedule numbers = schedule(slot);
    const auto is_equal = [&](std::uint32_t passes) {
        const std::uint32_t pass = film.passes + passes;
        const auto has_role = [&](std::uint32_t one) { return guiding_.role_of(slot, film, one) != PassRole::None; };
        if (has_role(pass - 1) || has_role(pass) || numbers.weight_of(pass) != numbers.weight_of(pass - 1))
            return false;
        return !learns || (!fields_.is_update_due(slot.method, pass) &&
                           fields_.is_trained_by_pass(slot.method, pass) == film.trains);
    };
    std::uint32_t passes = 1;
    while (passes < most && passes < left && is_equal(passes)) ++passes;
    return passes;
}

/// The parts of a pass that end before a pixel, each with its update. Returns false if it was stopped.
bool FilmRenderer::render_parts_before(FilmSlot slot, std::uint32_t pixel, const StopFlag* stop) {
    FilmProgress& film = films_[slot];
    for (std::uint32_t end = end_of_part(slot); end <= pixel; end = end_of_part(slot)) {
        render_part(slot, end, stop);
        if (film.next_pixel < end) return false;
        const Stopwatch watch;
        fields_.update_within_pass(slot.method);
        film.learn_seconds += watch.seconds();
    }
    return true;
}

std::uint32_t FilmRenderer::end_of_part(FilmSlot slot) const {
    const FilmProgress& film = films_[slot];
    const std::uint32_t pixels = inputs_.pixel_count();
    const bool is_young =
        fields_.progress(slot.method).passes == 0 || (film.is_guided && film.guiding.is_warm_up(film.passes));
    if (!film.trains || !is_young) return pixels;
    return end_of_first_part(film.next_pixel, pixels, static_cast<std::uint32_t>(fields_.placement().count()));
}

/// One sample for every pixel, by directions of a method.
PassRequest FilmRenderer::pass_request(FilmSlot slot, MethodId method, const StopFlag* stop) const {
    const RenderSettings& settings = inputs_.settings;
    const FilmProgress& film = films_[slot];
    const PassSchedule numbers = schedule(slot);
    PathSettings path = path_settings(settings, method);
    if (!film.runs.empty()) path.sequences = film.runs.back().sequences;
    return {.slot = slot,
            .is_guided = method == slot.method,
            .trains = film.trains,
            .features = inputs_.needed_features(slot).with(settings.forced_effects),
            .path = path,
            .camera = inputs_.camera(),
            .mixture = mixture_of(settings, method),
            .learning = settings.field.learning,
            // Passes of a heat map replace one another: they use the same points, so that borders do not flicker.
            .sample = is_heat_map(slot.view) ? 0 : numbers.sample_of(film.passes),
            .passes = film.passes + 1,
            .schedule = slot.view == View::Beauty ? numbers : PassSchedule{},
            .stop = stop};
}

void FilmRenderer::render_part(FilmSlot slot, std::uint32_t end, const StopFlag* stop, std::uint32_t most_passes) {
    const Stopwatch watch;
    FilmProgress& film = films_[slot];
    PassRequest request = pass_request(slot, film.is_guided ? slot.method : baseline_method(), stop);
    request.first_pixel = film.next_pixel;
    request.end_pixel = end;
    request.most_passes = most_passes;
    guiding_.shape(slot, film, request);
    const PassCounters counters = backend().run_pass(request);
    const double seconds = watch.seconds();
    film.render_seconds += seconds;
    film.guided_seconds += film.is_guided ? seconds : 0.0;
    film.counters += counters;
    film.measured += counters;
    note_escapes(slot, counters);
    film.next_pixel += static_cast<std::uint32_t>(counters.paths);
    if (slot.view == View::Beauty) fields_.count(slot.method, counters);
}

/// With light from far away the scene is open on purpose: escaped paths are not lost.
void FilmRenderer::note_escapes(FilmSlot slot, const PassCounters& counters) {
    if (counters.path.escaped == 0 || is_closed_) return;
    if (inputs_.needed_features(slot).has_any(features(Feature::Environment, Feature::EnvironmentMap))) return;
    const bool may_take_long = films_[slot].passes > 0;  // delays no first picture
    is_closed_ = inputs_.scene.encloses(inputs_.settings.camera.eye, may_take_long);
}

void FilmRenderer::finish_pass(FilmSlot slot) {
    guiding_.finish_pass(slot, films_[slot]);
    ++films_[slot].passes;
    if (learns_from(slot)) finish_learning_pass(slot);
}

/// The films stay where volumes are refined, since tables only guide the sampling; but passes of their cells would mix both placements.
void FilmRenderer::finish_learning_pass(FilmSlot slot) {
    const Stopwatch watch;
    FilmProgress& film = films_[slot];
    // Where few passes train, each is followed by an update.
    const bool is_rare = !film.guiding.pays() || film.guiding.is_warm_up(film.passes - 1);
    try {
        if (fields_.finish_pass(slot.method, film.trains, is_rare || fields_.is_update_due(slot.method, film.passes)))
            films_.clear(View::Voronoi);
    } catch (...) {
        if (!fields_.placement().is_placed()) {
            clear();
            forget_guiding();
        }
        throw;
    }
    film.learn_seconds += watch.seconds();
}

ShownFilm FilmRenderer::show(FilmSlot slot, const DisplaySettings& display) {
    ensure(slot);
    const float largest = ends_at_largest(slot.view) ? backend().largest_value(slot) : 0.0f;
    const ShownRange range = shown_range(slot.view, fields_.placement().bins(), largest);
    return {backend().show_film(slot, frame_style(slot.view, display, range)), range};
}

FilmReading FilmRenderer::read(FilmSlot slot) const {
    return films_[slot].is_allocated ? backend().read_film(slot) : FilmReading{};
}

FilmReading FilmRenderer::read_halves(FilmSlot slot) const {
    return films_[slot].is_allocated ? backend().read_halves(slot) : FilmReading{};
}

void FilmRenderer::clear() {
    films_.clear();
    is_closed_.reset();
}

void FilmRenderer::switch_to(const ParkedBackend& next, bool returns) {
    if (returns) films_.park(inputs_.backend, inputs_.scene.packed());
    films_.resume(next);
}

std::uint64_t FilmRenderer::state_bytes() const {
    std::uint64_t bytes = 0;
    for (const MethodInfo& method : all_methods())
        for (const ViewInfo& view : all_views())
            bytes += films_[{method.id, view.id}].is_allocated ? inputs_.pixel_count() * sizeof(FilmPixel) : 0;
    return bytes;
}

void FilmRenderer::save_state(SessionState& state) const {
    state.is_closed = is_closed_;
    for (const MethodInfo& method : all_methods())
        for (const ViewInfo& view : all_views()) {
            const FilmSlot slot{method.id, view.id};
            const FilmProgress& film = films_[slot];
            if (film.origin.number == 0 && !film.is_allocated) continue;
            SavedFilm& saved = state.films.emplace_back(SavedFilm{.slot = slot, .progress = film});
            if (!film.is_allocated) continue;
            saved.pixels.resize(inputs_.pixel_count());
            exact(backend()).read_pixels(slot, 0, saved.pixels);
        }
}

void FilmRenderer::restore_state(SessionState& state) {
    for (SavedFilm& saved : state.films) {
        if (!saved.pixels.empty()) {
            reset(saved.slot);
            exact(backend()).write_pixels(saved.slot, 0, saved.pixels);
        }
        films_.restore(saved.slot, std::move(saved.progress));
    }
    if (state.is_closed) is_closed_ = state.is_closed;
}

}  // namespace pl
