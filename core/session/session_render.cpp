// The part of Session that renders: precomputation and passes, piece by piece, and what is learned from them.
#include <cmath>

#include "core/base/timer.h"
#include "core/scene/pack_scene.h"
#include "core/session/session.h"
#include "core/session/update_schedule.h"

namespace pl {
namespace {

/// Paths guided by what was learned know what they are still worth, and soon end at a light: they play roulette only
/// when a fifth is left, so that few of them end without having found any. Others play for every loss. Lower thresholds leave a
/// little less noise for the same samples and more for the same time (docs/learning.md).
constexpr float kGuidedRouletteThreshold = 0.2f;
/// Where what is learned decides alone: the lower end of a window of weights whose ends differ by a factor of 5, around 1.
/// [Vorba and Krivanek 2016, section 4]
constexpr float kFieldRouletteThreshold = 2.0f / (1.0f + 5.0f);

/// Above twice what was expected of them at first, paths are split (docs/learning.md).
constexpr float kSplitThreshold = 2.0f;

bool learns_from(FilmSlot slot) { return slot.view == View::Beauty && info_of(slot.method).learns; }

bool is_power_of_two(std::uint32_t n) { return n != 0 && (n & (n - 1)) == 0; }

}  // namespace

PathSettings Session::path_settings() const {
    const bool is_guided = info_of(settings_.method).uses_field;
    const bool splits = is_guided && settings_.roulette != RouletteRule::Albedo;
    const float threshold =
        settings_.roulette == RouletteRule::Field ? kFieldRouletteThreshold : kGuidedRouletteThreshold;
    return {.seed = settings_.seed,
            .max_depth = static_cast<std::uint32_t>(settings_.max_depth),
            .roulette_threshold = is_guided ? threshold : 1.0f,
            .split_threshold = splits ? kSplitThreshold : kInfinity,
            .roulette = settings_.roulette,
            .next_event = settings_.next_event ? 1u : 0u};
}

/// Shares are learned by what paths bring, so a map that is frozen keeps the set one.
MixtureSettings Session::mixture_of(MethodId method) const {
    MixtureSettings mixture = settings_.mixture;
    if (!info_of(method).learns) mixture.learned = 0;
    return mixture;
}

bool Session::needs_precompute() const {
    const bool wanted = settings_.view == View::Beauty || info_of(settings_.view).needs_tables;
    return wanted && settings_.method == MethodId::Precomputed &&
           field().precomputed_slices < static_cast<std::uint32_t>(settings_.field.precompute_samples);
}

Progress Session::precompute_slice(const StopFlag* stop) {
    const Stopwatch watch;
    FieldProgress& state = field();
    film().origin.forced = film().origin.forced.with(settings_.forced_effects);
    PathSettings path = path_settings();
    path.stream = Stream::Precompute;
    path.roulette_threshold = 1.0f;  // probes follow the default method
    const auto slices = static_cast<std::uint32_t>(settings_.field.precompute_samples);
    const PassCounters counters =
        backend_->precompute({.method = settings_.method,
                              .features = needed_features().with(settings_.forced_effects),
                              .path = path,
                              .sample = state.precomputed_slices,
                              .strata_side = static_cast<std::uint32_t>(std::lround(std::sqrt(slices))),
                              .first_probe = state.next_probe,
                              .stop = stop});
    state.records += counters.paths;
    state.clamped_records += counters.path.method.clamped_records;
    state.next_probe += static_cast<std::uint32_t>(counters.paths);
    const bool complete = state.next_probe >= probe_count();
    if (complete) {
        state.next_probe = 0;
        if (++state.precomputed_slices == slices) {
            backend_->update_field(settings_.method);
            ++state.passes;
        }
    }
    state.precompute_seconds += watch.seconds();
    return complete ? Progress::Precomputed : Progress::Stopped;
}

std::uint32_t Session::probe_count() const {
    return static_cast<std::uint32_t>(volumes_->normals.size()) * static_cast<std::uint32_t>(shape_.cells.count());
}

Progress Session::render_slot(FilmSlot target, const StopFlag* stop) {
    begin_film(target);
    ensure_film(target);
    FilmState& state = films_[static_cast<std::size_t>(target.index())];
    if (state.next_pixel == 0) {
        if (learns_from(target)) field() = field().without_part();
        // What is learned changes under the map: restarting at powers of two keeps at least half of the samples recent.
        if (target.view == View::RadianceMap && is_power_of_two(state.passes))
            backend_->reset_film(target, settings_.width, settings_.height);
    }
    return render_pass(target, state, stop);
}

/// What is left of a pass, part by part.
Progress Session::render_pass(FilmSlot target, FilmState& state, const StopFlag* stop) {
    while (true) {
        const std::uint32_t end = end_of_part(target, state);
        render_part(target, state, end, stop);
        if (state.next_pixel < end) return Progress::Stopped;
        if (end == pixel_count()) break;
        finish_learning_part(state);
    }
    state.next_pixel = 0;
    ++state.passes;
    if (learns_from(target)) finish_learning_pass(state);
    return Progress::Rendered;
}

std::uint32_t Session::end_of_part(FilmSlot target, const FilmState& state) const {
    if (!learns_from(target) || field().passes > 0) return pixel_count();
    return end_of_first_part(state.next_pixel, pixel_count(), static_cast<std::uint32_t>(volumes_->normals.size()));
}

void Session::render_part(FilmSlot target, FilmState& state, std::uint32_t end, const StopFlag* stop) {
    const Stopwatch watch;
    // Numbers that the tables were not learned from, see FieldProgress::without_part().
    std::uint32_t sample = learns_from(target) ? static_cast<std::uint32_t>(field().passes) : state.passes;
    // Passes of a heat map replace one another: with the same points, so that borders stand still.
    if (is_heat_map(target.view)) sample = 0;
    state.origin.forced = state.origin.forced.with(settings_.forced_effects);
    const PassCounters counters =
        backend_->run_pass({.slot = target,
                            .features = needed_features().with(settings_.forced_effects),
                            .path = path_settings(),
                            .camera = make_camera(settings_.camera, settings_.width, settings_.height),
                            .mixture = mixture_of(target.method),
                            .learning = settings_.field.learning,
                            .sample = sample,
                            .first_pixel = state.next_pixel,
                            .end_pixel = end,
                            .stop = stop});
    state.render_seconds += watch.seconds();
    state.counters += counters;
    note_escapes(counters);
    state.next_pixel += static_cast<std::uint32_t>(counters.paths);
    if (target.view == View::Beauty) {
        field().records += counters.path.method.records;
        field().clamped_records += counters.path.method.clamped_records;
        field().lookup_misses += counters.path.method.lookup_misses;
    }
}

void Session::finish_learning_part(FilmState& state) {
    const Stopwatch watch;
    backend_->update_field(settings_.method);
    field().has_part = true;
    state.learn_seconds += watch.seconds();
}

void Session::finish_learning_pass(FilmState& state) {
    const Stopwatch watch;
    const bool is_updated = is_updated_after(state.passes);
    if (is_updated) backend_->update_field(settings_.method);
    ++field().passes;
    field().has_part = false;
    if (is_updated) refine_if_due();
    state.learn_seconds += watch.seconds();
}

Progress Session::advance(const StopFlag* stop) {
    begin_film(slot());
    const ViewInfo& view = info_of(settings_.view);
    if (view.needs_volumes) ensure_volumes();
    if (info_of(settings_.method).uses_field || view.needs_tables) ensure_tables();
    if (needs_precompute()) return precompute_slice(stop);
    if (view.needs_tables && info_of(settings_.method).learns && film().next_pixel == 0) {
        const Progress learned = render_slot({settings_.method, View::Beauty}, stop);
        if (learned == Progress::Stopped) return learned;
    }
    return render_slot(slot(), stop);
}

}  // namespace pl
