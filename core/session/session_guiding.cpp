// The part of Session that chooses between guided passes and those of the baseline method.
#include <algorithm>

#include "core/base/timer.h"
#include "core/session/path_settings.h"
#include "core/session/session.h"
#include "core/session/update_schedule.h"

namespace pl {
namespace {

/// Paths of a trial, at least: enough for a rough variance, and for a field that has learned from a few of them to show whether it
/// will pay (docs/notebook/2026-11-24-warm-up.md).
constexpr std::uint32_t kTrialPaths = 16384;
/// Pixels that share a path of a trial, at most: a larger picture has time for more of them.
constexpr std::uint32_t kLargestStep = 64;
/// Pixels that share a path of a trial from which on a warm-up is cheap beside the passes: from pictures of 256 x 256 pixels on.
constexpr std::uint32_t kStepForWarmUp = 4;

}  // namespace

/// Without light samples the baseline finds light so rarely that a few passes do not show its variance.
bool Session::chooses_guiding(FilmSlot slot) const {
    return settings_.guiding == GuidingRule::Paying && settings_.next_event && slot.view == View::Beauty &&
           info_of(slot.method).uses_field;
}

/// Smaller pictures learn and measure by their first passes: a warm-up would cost as many.
bool Session::warms_up(FilmSlot slot) const { return chooses_guiding(slot) && trial_step() >= kStepForWarmUp; }

/// Number of pixels that share a path of a trial.
std::uint32_t Session::trial_step() const { return std::clamp(pixel_count() / kTrialPaths, 1u, kLargestStep); }

GuidingTerms::Field Session::state_of_field(MethodId method) const {
    if (info_of(method).learns) return GuidingTerms::Field::Learning;
    return is_map_complete(method) ? GuidingTerms::Field::Complete : GuidingTerms::Field::Coarse;
}

GuidingTerms Session::guiding_terms(FilmSlot slot) const {
    return {.costs = PathCosts::of(scene_.packed()->triangles.size(), needed_features(slot),
                                   representation_of(settings_.field, slot.method), info_of(slot.method).learns),
            .pixels = static_cast<double>(pixel_count()),
            .volumes = static_cast<double>(placement_.count()),
            .field = state_of_field(slot.method)};
}

/// Decides about the passes that begin, up to the next choice. Returns false if the trials before them were stopped: the next call
/// resumes them.
bool Session::choose_guiding(FilmSlot slot, const StopFlag* stop) {
    FilmProgress& state = films_[slot];
    if (state.next_pixel > 0 || !chooses_guiding(slot) || !is_chosen_after(state.passes)) return true;
    const bool knows = info_of(slot.method).learns && (field(slot.method).passes > 0 || is_frozen(slot.method));
    if (knows && state.guiding.is_warming_up()) state.guiding.trust_field();
    if (!warms_up(slot)) state.guiding.begin_guided();
    if (state.guiding.is_warming_up() && !warm_up(slot, stop)) return false;
    const Trial trial = state.guiding.trial_before(state.passes);
    if (trial.is_due()) {
        if (!run_trial(slot, trial, stop)) return false;
        state.guiding.measure_trial(state.passes, state.trial.guided, state.trial.baseline, guiding_terms(slot));
        state.trial = {};
    }
    state.measured = {};
    state.is_guided = state.guiding.pays();
    return true;
}

/// Trains an unknown field and measures both methods, before the first pass, by paths in a film that is cleared afterwards. Since
/// the picture has none of these samples, the choice is independent of it. Returns false if it was stopped.
bool Session::warm_up(FilmSlot slot, const StopFlag* stop) {
    FilmProgress& state = films_[slot];
    while (state.guiding.is_warming_up()) {
        if (!run_trial(slot, state.guiding.warm_up_round(guiding_terms(slot)), stop)) return false;
        state.guiding.measure_round(state.trial.guided, state.trial.baseline, guiding_terms(slot));
        state.trial = {};
    }
    backend_->reset_film(slot, settings_.width, settings_.height);
    return true;
}

/// Traces the rest of a trial's paths; the field learns from them at once. Returns false if it was stopped.
bool Session::run_trial(FilmSlot slot, Trial trial, const StopFlag* stop) {
    const Stopwatch watch;
    FilmProgress& state = films_[slot];
    PassCounters& done = trial.is_guided ? state.trial.guided : state.trial.baseline;
    PassRequest request = trial_request(slot, trial, stop);
    const std::uint32_t end = request.subset.count(pixel_count());
    request.first_pixel = static_cast<std::uint32_t>(done.paths);
    if (request.first_pixel >= end) return true;
    const PassCounters counters = backend_->run_pass(request);
    done += counters;
    state.trial_paths += counters.paths;
    FieldProgress& learned = field(slot.method);
    learned.records += counters.path.method.records;
    learned.clamped_records += counters.path.method.clamped_records;
    learned.lookup_misses += counters.path.method.lookup_misses;
    const bool is_complete = done.paths >= end;
    if (is_complete && trains_by(slot, trial)) update_trained(slot.method);
    state.learn_seconds += watch.seconds();
    return is_complete;
}

/// Whether the paths of a trial train the field: guided ones, and in a warm-up those of the baseline, by the kernel of the method that
/// learns. The latter meet light that the field does not know as often as light that it knows.
bool Session::trains_by(FilmSlot slot, Trial trial) const {
    const bool is_training = trial.is_guided || films_[slot].guiding.is_warming_up();
    return is_training && info_of(slot.method).learns && !is_frozen(slot.method);
}

/// Paths of the warm-up come to the film, because later ones are measured against it; all others leave it as it is.
PassRequest Session::trial_request(FilmSlot slot, Trial trial, const StopFlag* stop) const {
    const FilmProgress& state = films_[slot];
    const bool is_warm_up = state.guiding.is_warming_up();
    const bool has_own_kernel = trial.is_guided || trains_by(slot, trial);
    PassRequest request = pass_request(slot, has_own_kernel ? slot.method : baseline_method(), stop);
    if (!trial.is_guided) {
        request.path = path_settings(settings_, baseline_method());
        request.path.roulette = RouletteRule::Albedo;
        request.mixture = MixtureSettings::unguided();
    }
    request.path.stream = is_warm_up ? Stream::WarmUp : Stream::Trial;
    request.trains = !is_frozen(slot.method);
    // A small picture has few paths to spare beside its passes.
    request.subset.step = trial_step() * (trial.is_guided || warms_up(slot) ? 1 : 2);
    if (is_warm_up) {
        request.sample = state.guiding.rounds();
        request.passes = request.sample + 1;
        request.use = request.sample < kFewestBeforeVariance ? SampleUse::Film : SampleUse::Measured;
    } else {
        if (trial.passes > 0.0)
            request.subset.step = static_cast<std::uint32_t>(
                std::clamp(1.0 / trial.passes, 1.0, static_cast<double>(request.subset.step)));
        request.subset.phase = state.passes % request.subset.step;
        request.use = SampleUse::Trial;
    }
    return request;
}

/// Counts the pass that has ended, and measures all since the last choice if another one follows.
void Session::measure_guiding(FilmSlot slot) {
    if (!chooses_guiding(slot)) return;
    FilmProgress& state = films_[slot];
    if (!state.is_guided) ++state.unguided_passes;
    if (is_chosen_after(state.passes + 1))
        state.guiding.measure_pass(state.passes, state.measured, guiding_terms(slot));
}

std::optional<GuidingStatus> Session::guiding_status(FilmSlot slot) const {
    if (!chooses_guiding(slot)) return std::nullopt;
    const FilmProgress& state = films_[slot];
    return GuidingStatus{.pays = state.guiding.pays(),
                         .gain = state.guiding.gain(),
                         .unguided_passes = state.unguided_passes,
                         .trial_paths = state.trial_paths};
}

}  // namespace pl
