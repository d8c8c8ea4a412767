// The part of Session that renders: passes, piece by piece, and the updates of learned fields.
#include <algorithm>

#include "core/base/timer.h"
#include "core/scene/pack_scene.h"
#include "core/session/path_settings.h"
#include "core/session/session.h"
#include "core/session/update_schedule.h"

namespace pl {
namespace {

bool learns_from(FilmSlot slot) { return slot.view == View::Beauty && info_of(slot.method).learns; }

bool is_power_of_two(std::uint32_t n) { return n != 0 && (n & (n - 1)) == 0; }

}  // namespace

Progress Session::advance(FilmSlot slot, const StopFlag* stop, std::uint32_t most_passes) {
    prepare_film(slot);
    const ViewInfo& view = info_of(slot.view);
    if (needs_precompute(slot)) return precompute_slice(slot, stop);
    if (view.needs_tables && info_of(slot.method).learns && films_[slot].next_pixel == 0) {
        const Progress learned = render_slot({slot.method, View::Beauty}, stop);
        if (learned == Progress::Stopped) return learned;
    }
    return render_slot(slot, stop, most_passes);
}

Progress Session::advance_to_path(FilmSlot slot, std::uint32_t pixel, const StopFlag* stop) {
    prepare_film(slot);
    if (needs_precompute(slot)) return precompute_slice(slot, stop);
    prepare_pass(slot);
    if (!choose_guiding(slot, stop)) return Progress::Stopped;
    if (needs_precompute(slot)) return Progress::Precomputed;
    begin_run_if_due(slot);
    return render_parts_before(slot, pixel, stop) ? Progress::Rendered : Progress::Stopped;
}

void Session::prepare_film(FilmSlot slot) {
    begin_film(slot);
    ensure_film(slot);  // before the work for it: it may not fit the memory
    const ViewInfo& view = info_of(slot.view);
    if (view.needs_volumes) ensure_volumes();
    if (info_of(slot.method).uses_field || view.needs_tables) ensure_tables(slot.method);
}

void Session::begin_film(FilmSlot slot) {
    const FieldProgress& learned = field(slot.method);
    films_.begin(slot, {.warm = learned.passes > 0 || learned.has_part || learned.precomputed_slices > 0 ||
                                learned.next_probe > 0,
                        .place_seconds = placement_.seconds(),
                        .precompute_seconds = learned.precompute_seconds});
}

void Session::ensure_film(FilmSlot slot) {
    FilmProgress& state = films_[slot];
    if (state.is_allocated) return;
    backend_->reset_film(slot, settings_.width, settings_.height);
    state = FilmProgress{.origin = state.origin, .guiding = state.guiding};
    state.is_allocated = true;
}

Progress Session::render_slot(FilmSlot slot, const StopFlag* stop, std::uint32_t most_passes) {
    begin_film(slot);
    prepare_pass(slot);
    return render_passes(slot, stop, most_passes);
}

void Session::prepare_pass(FilmSlot slot) {
    ensure_film(slot);
    const FilmProgress& state = films_[slot];
    if (state.next_pixel > 0) return;
    if (learns_from(slot)) {
        field(slot.method) = field(slot.method).without_part();
        prepare_training(slot);
    }
    // The map shows a changing field: restarting at powers of two keeps at least half of the samples recent.
    if (slot.view == View::RadianceMap && is_power_of_two(state.passes))
        backend_->reset_film(slot, settings_.width, settings_.height);
}

/// The rest of a pass, in parts, or several whole passes.
Progress Session::render_passes(FilmSlot slot, const StopFlag* stop, std::uint32_t most) {
    FilmProgress& state = films_[slot];
    if (!choose_guiding(slot, stop)) return Progress::Stopped;
    if (needs_precompute(slot)) return Progress::Precomputed;  // by the choice just made
    begin_run_if_due(slot);
    if (!render_parts_before(slot, pixel_count() - 1, stop)) return Progress::Stopped;
    render_part(slot, pixel_count(), stop, equal_passes(slot, most));
    if (state.next_pixel < pixel_count()) return Progress::Stopped;
    for (; state.next_pixel >= pixel_count(); state.next_pixel -= pixel_count()) finish_pass(slot);
    return Progress::Rendered;
}

/// Tables are trained by the members that passes have drawn, so after each of their changes passes that train draw from sequences of
/// their own. On the others nothing depends but the choice of guiding: while it stays they go on where the last of them ended.
void Session::begin_run_if_due(FilmSlot slot) {
    FilmProgress& state = films_[slot];
    std::vector<PassRun>& runs = state.runs;
    if (state.next_pixel > 0 || slot.view != View::Beauty) return;
    PassRun next{.first_pass = state.passes,
                 .first_sample = sample_number(slot),
                 .is_guided = state.is_guided,
                 .trains = learns_from(slot) && state.is_guided && state.trains};
    next.sequences = next.trains ? next.own_sequences() : next.sequences_behind(runs);
    const std::uint64_t updates = field(slot.method).updates;
    const bool goes_on =
        !runs.empty() && next.is_like(runs.back()) && (!next.trains || updates == state.updates_seen);
    if (goes_on || (!runs.empty() && runs.back().first_pass == state.passes))
        return;  // or it was stopped before its first path
    runs.push_back(next);
    state.updates_seen = updates;
}

/// Of the pass under way. Random numbers of a learner go by the passes of its field, since those of its earlier pictures have trained
/// the tables, see FieldProgress::without_part().
std::uint32_t Session::sample_number(FilmSlot slot) const {
    return learns_from(slot) ? static_cast<std::uint32_t>(field(slot.method).passes) : films_[slot].passes;
}

/// The number of passes from the present one on, at most `most`, between which nothing changes but the number of the sample.
std::uint32_t Session::equal_passes(FilmSlot slot, std::uint32_t most) const {
    const FilmProgress& state = films_[slot];
    if (slot.view != View::Beauty || state.next_pixel > 0) return 1;
    const bool learns = learns_from(slot) && state.is_guided && !is_frozen(slot.method);
    if (!learns && !chooses_guiding(slot)) return most;
    const std::uint64_t left = learns ? settings_.learn_passes - trained_passes(slot.method) : most;
    const auto is_equal = [&](std::uint32_t pass) {
        if (chooses_guiding(slot) && is_chosen_after(pass)) return false;
        return !learns || (!is_update_due(slot, pass) && is_trained_by_pass(slot, pass) == state.trains);
    };
    std::uint32_t passes = 1;
    while (passes < most && passes < left && is_equal(state.passes + passes)) ++passes;
    return passes;
}

void Session::finish_pass(FilmSlot slot) {
    measure_guiding(slot);
    ++films_[slot].passes;
    if (learns_from(slot)) finish_learning_pass(slot);
}

/// The parts of a pass that end before a pixel, each with its update. Returns false if it was stopped.
bool Session::render_parts_before(FilmSlot slot, std::uint32_t pixel, const StopFlag* stop) {
    for (std::uint32_t end = end_of_part(slot); end <= pixel; end = end_of_part(slot)) {
        render_part(slot, end, stop);
        if (films_[slot].next_pixel < end) return false;
        finish_learning_part(slot);
    }
    return true;
}

std::uint32_t Session::end_of_part(FilmSlot slot) const {
    const bool trains = learns_from(slot) && films_[slot].trains;
    if (!trains || warms_up(slot) || field(slot.method).passes > 0) return pixel_count();
    return end_of_first_part(films_[slot].next_pixel, pixel_count(), static_cast<std::uint32_t>(placement_.count()));
}

/// Where a warm-up has trained the field, its first passes are as good as the others, unless light is hidden.
bool Session::first_passes_weigh_less(FilmSlot slot) const {
    return learns_from(slot) && (!warms_up(slot) || films_[slot].guiding.found_hidden_light());
}

/// One sample for every pixel, by directions of a method.
PassRequest Session::pass_request(FilmSlot slot, MethodId method, const StopFlag* stop) const {
    const FilmProgress& state = films_[slot];
    // Passes of a heat map replace one another: they use the same points, so that borders do not flicker.
    const std::uint32_t sample = is_heat_map(slot.view) ? 0 : sample_number(slot);
    PathSettings path = path_settings(settings_, method);
    if (!state.runs.empty()) path.sequences = state.runs.back().sequences;
    return {.slot = slot,
            .is_guided = method == slot.method,
            .trains = state.trains,
            .features = needed_features(slot).with(settings_.forced_effects),
            .path = path,
            .camera = view_camera(),
            .mixture = mixture_of(settings_, method),
            .learning = settings_.field.learning,
            .sample = sample,
            .passes = state.passes + 1,
            .weights = first_passes_weigh_less(slot) ? pass_weights(settings_, slot.method) : PassWeights{},
            .stop = stop};
}

void Session::render_part(FilmSlot slot, std::uint32_t end, const StopFlag* stop, std::uint32_t most_passes) {
    const Stopwatch watch;
    FilmProgress& state = films_[slot];
    FieldProgress& learned = field(slot.method);
    PassRequest request = pass_request(slot, state.is_guided ? slot.method : baseline_method(), stop);
    request.first_pixel = state.next_pixel;
    request.end_pixel = end;
    request.most_passes = most_passes;
    if (chooses_guiding(slot) && state.passes >= kFewestBeforeVariance) request.use = SampleUse::Measured;
    const PassCounters counters = backend_->run_pass(request);
    state.render_seconds += watch.seconds();
    state.counters += counters;
    state.measured += counters;
    note_escapes(slot, counters);
    state.next_pixel += static_cast<std::uint32_t>(counters.paths);
    if (slot.view == View::Beauty) {
        learned.records += counters.path.method.records;
        learned.clamped_records += counters.path.method.clamped_records;
        learned.lookup_misses += counters.path.method.lookup_misses;
    }
}

void Session::finish_learning_part(FilmSlot slot) {
    const Stopwatch watch;
    backend_->update_field(slot.method);
    ++field(slot.method).updates;
    field(slot.method).has_part = true;
    films_[slot].learn_seconds += watch.seconds();
}

void Session::finish_learning_pass(FilmSlot slot) {
    const Stopwatch watch;
    const FilmProgress& state = films_[slot];
    const bool has_trained = state.is_guided && state.trains;
    FieldProgress& learned = field(slot.method);
    ++learned.passes;
    learned.untrained_passes += has_trained ? 0u : 1u;
    // Where guiding does not pay, passes that learn are rare.
    const bool is_updated =
        has_trained && (is_update_due(slot, state.passes) || !state.guiding.pays() || is_frozen(slot.method));
    if (is_updated) update_trained(slot.method);
    learned.has_part = false;
    if (is_updated) refine_if_due(slot.method);
    films_[slot].learn_seconds += watch.seconds();
}

}  // namespace pl
