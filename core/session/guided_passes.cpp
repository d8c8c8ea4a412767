#include "core/session/guided_passes.h"

#include <algorithm>

#include "core/base/timer.h"
#include "core/session/path_settings.h"

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

bool GuidedPasses::chooses(FilmSlot slot) const {
    return inputs_.settings.guiding == GuidingRule::Paying && inputs_.settings.next_event &&
           slot.view == View::Beauty && info_of(slot.method).uses_field;
}

bool GuidedPasses::warms_up(FilmSlot slot) const { return chooses(slot) && trial_step() >= kStepForWarmUp; }

bool GuidedPasses::coarse_map_suffices(FilmSlot slot, const FilmProgress& film) const {
    return warms_up(slot) && (film.guiding.is_warming_up() || !film.guiding.pays());
}

bool GuidedPasses::first_passes_are_noisy(FilmSlot slot, const FilmProgress& film) const {
    return !warms_up(slot) || film.guiding.found_hidden_light();
}

/// Number of pixels that share a path of a trial.
std::uint32_t GuidedPasses::trial_step() const {
    return std::clamp(inputs_.pixel_count() / kTrialPaths, 1u, kLargestStep);
}

double GuidedPasses::least_ratio(FilmSlot slot) const {
    return GuidingChoice::least_ratio(guidance_of(representation_of(inputs_.settings.field, slot.method)));
}

bool GuidedPasses::is_choice_due(FilmSlot slot, const FilmProgress& film) const {
    return !film.is_under_way() && chooses(slot) && film.guiding.is_due_before(film.passes);
}

bool GuidedPasses::choose(FilmSlot slot, FilmProgress& film, const PassRequest& pass) {
    const bool knows =
        info_of(slot.method).learns && (fields_.progress(slot.method).passes > 0 || fields_.is_frozen(slot.method));
    if (knows || !warms_up(slot)) film.guiding.begin_guided();
    if (film.guiding.is_warming_up() && !warm_up(slot, film, pass)) return false;
    const Trial trial = film.guiding.trial_before(film.passes);
    if (trial != Trial::None) {
        if (!run_trial(film, trial, pass)) return false;
        film.guiding.measure_trial(film.passes, film.trial);
        film.trial = {};
    }
    film.measured = {};
    film.is_guided = film.guiding.pays();
    return true;
}

/// Trains an unknown field and measures both methods, before the first pass, by paths in a film that is cleared afterwards. Since
/// the picture has none of these samples, the choice is independent of it. Returns false if it was stopped.
bool GuidedPasses::warm_up(FilmSlot slot, FilmProgress& film, const PassRequest& pass) {
    while (film.guiding.is_warming_up()) {
        if (!run_trial(film, film.guiding.warm_up_trial(), pass)) return false;
        film.guiding.measure_warm_up(film.trial, least_ratio(slot));
        film.trial = {};
    }
    inputs_.backend->reset_film(slot, inputs_.settings.width, inputs_.settings.height);
    return true;
}

/// Traces the rest of a trial's paths; the field learns from them at once. Returns false if it was stopped.
bool GuidedPasses::run_trial(FilmProgress& film, Trial trial, const PassRequest& pass) {
    const Stopwatch watch;
    const MethodId method = pass.slot.method;
    PassCounters& done = film.trial;
    PassRequest request = trial_request(film, trial, pass);
    const std::uint32_t end = request.subset.count(inputs_.pixel_count());
    request.first_pixel = static_cast<std::uint32_t>(done.paths);
    if (request.first_pixel >= end) return true;
    const PassCounters counters = inputs_.backend->run_pass(request);
    done += counters;
    film.trial_paths += counters.paths;
    fields_.count(method, counters);
    const bool is_complete = done.paths >= end;
    if (is_complete && trains_by(film, method, trial)) fields_.update(method);
    film.learn_seconds += watch.seconds();
    return is_complete;
}

/// Whether the paths of a trial train the field: guided paths do, and paths of the baseline in the first rounds of a warm-up, by the kernel
/// of the method that learns, which doubles their time. Paths of the baseline find light that the field has not learned as often as light
/// that it has.
bool GuidedPasses::trains_by(const FilmProgress& film, MethodId method, Trial trial) const {
    const bool is_first = film.guiding.is_warming_up() && !film.guiding.is_round_measured();
    const bool is_training = trial == Trial::Guided || is_first;
    return is_training && info_of(method).learns && !fields_.is_frozen(method);
}

/// Paths of the warm-up are added to the film, because later paths are measured against it. Measured paths of the baseline, and all other
/// trials, leave the film as it is.
PassRequest GuidedPasses::trial_request(const FilmProgress& film, Trial trial, PassRequest request) const {
    const FilmSlot slot = request.slot;
    const bool is_guided = trial == Trial::Guided;
    request.is_guided = is_guided || trains_by(film, slot.method, trial);
    if (!is_guided) {
        request.path = path_settings(inputs_.settings, baseline_method());
        request.path.roulette = RouletteRule::Albedo;
        request.mixture = MixtureSettings::unguided();
    }
    request.path.stream = Stream::Trial;
    request.trains = !fields_.is_frozen(slot.method);
    request.use = SampleUse::Trial;
    // A small picture has few paths to spare beside its passes.
    request.subset.step = trial_step() * (is_guided || warms_up(slot) ? 1 : 2);
    if (film.guiding.is_warming_up()) {
        request.sample = film.guiding.warm_up_round();
        request.passes = request.sample + 1;
        const bool is_measured = film.guiding.is_round_measured();
        if (is_measured && !is_guided) return request;
        request.path.stream = Stream::WarmUp;
        request.use = is_measured ? SampleUse::Measured : SampleUse::Film;
    } else {
        request.subset.phase = film.passes % request.subset.step;
    }
    return request;
}

void GuidedPasses::finish_pass(FilmSlot slot, FilmProgress& film) const {
    if (!chooses(slot)) return;
    if (!film.is_guided) ++film.unguided_passes;
    if (measures(slot, film)) film.guiding.measure_pass(film.passes, film.measured, least_ratio(slot));
}

std::optional<GuidingStatus> GuidedPasses::status(FilmSlot slot, const FilmProgress& film) const {
    if (!chooses(slot)) return std::nullopt;
    return GuidingStatus{.pays = film.guiding.pays(),
                         .variance_ratio = film.guiding.variance_ratio(),
                         .unguided_passes = film.unguided_passes,
                         .trial_paths = film.trial_paths};
}

}  // namespace pl
