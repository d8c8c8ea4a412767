// The part of Session that chooses between guided passes and those of the baseline method.
#include <algorithm>

#include "core/base/timer.h"
#include "core/session/session.h"

namespace pl {
namespace {

/// Paths of a trial: enough for a rough variance, and little beside the passes of a picture.
constexpr std::uint32_t kTrialPaths = 8192;

}  // namespace

/// Without light samples the baseline finds light so rarely that a few passes do not show its variance.
bool Session::chooses_guiding(FilmSlot slot) const {
    return settings_.guiding == GuidingRule::Paying && settings_.next_event && slot.view == View::Beauty &&
           info_of(slot.method).uses_field;
}

PathCosts Session::path_costs(FilmSlot slot) const {
    return PathCosts::of(scene_.packed()->triangles.size(), needed_features(slot));
}

/// Decides about the pass that begins. Returns false if the trial before it was stopped: it is repeated as a whole.
bool Session::choose_guiding(FilmSlot slot, const StopFlag* stop) {
    if (!chooses_guiding(slot)) return true;
    FilmProgress& state = films_[slot];
    if (state.guiding.is_trial_due(state.passes) && !run_trial(slot, stop)) return false;
    state.measured = {};
    const bool is_guided = state.guiding.guides(state.passes);
    if (is_guided != state.is_guided) state.switches.push_back(state.passes);
    state.is_guided = is_guided;
    return true;
}

/// Measures the variance of the baseline method against the film so far, with random numbers of its own. Its samples never
/// come to the film, however they turn out: a choice by their values would be a bias.
bool Session::run_trial(FilmSlot slot, const StopFlag* stop) {
    const Stopwatch watch;
    FilmProgress& state = films_[slot];
    PassRequest request = pass_request(slot, baseline_method(), stop);
    request.path.stream = Stream::Trial;
    request.use = SampleUse::Trial;
    request.subset.step = std::max(1u, pixel_count() / kTrialPaths);
    const PassCounters counters = backend_->run_pass(request);
    state.render_seconds += watch.seconds();
    state.trial_paths += counters.paths;
    if (counters.paths < request.subset.count(pixel_count())) return false;
    state.guiding.measure_trial(counters);
    return true;
}

/// Measures the pass that has ended.
void Session::measure_guiding(FilmSlot slot) {
    if (!chooses_guiding(slot)) return;
    FilmProgress& state = films_[slot];
    if (state.is_guided) {
        state.guiding.measure_guided(state.passes, state.measured, path_costs(slot));
    } else {
        state.guiding.measure_unguided(state.measured);
        ++state.unguided_passes;
    }
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
