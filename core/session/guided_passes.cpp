#include "core/session/guided_passes.h"

#include <algorithm>

#include "core/base/timer.h"
#include "core/session/path_settings.h"
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

GuidingTerms GuidedPasses::terms(FilmSlot slot) const {
    using Field = GuidingTerms::Field;
    const bool learns = info_of(slot.method).learns;
    return {.costs = PathCosts::of(inputs_.scene.packed()->triangles.size(), inputs_.needed_features(slot),
                                   representation_of(inputs_.settings.field, slot.method), learns),
            .pixels = static_cast<double>(inputs_.pixel_count()),
            .volumes = static_cast<double>(fields_.placement().count()),
            .field = learns                                 ? Field::Learning
                     : fields_.is_map_complete(slot.method) ? Field::Complete
                                                            : Field::Coarse};
}

bool GuidedPasses::is_choice_due(FilmSlot slot, const FilmProgress& film) const {
    return !film.is_under_way() && chooses(slot) && is_chosen_after(film.passes);
}

bool GuidedPasses::choose(FilmSlot slot, FilmProgress& film, const PassRequest& pass) {
    const bool knows =
        info_of(slot.method).learns && (fields_.progress(slot.method).passes > 0 || fields_.is_frozen(slot.method));
    if (knows && film.guiding.is_warming_up()) film.guiding.trust_field();
    if (!warms_up(slot)) film.guiding.begin_guided();
    if (film.guiding.is_warming_up() && !warm_up(slot, film, pass)) return false;
    const Trial trial = film.guiding.trial_before(film.passes);
    if (trial.is_due()) {
        if (!run_trial(film, trial, pass)) return false;
        film.guiding.measure_trial(film.passes, film.trial.guided, film.trial.baseline, terms(slot));
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
        if (!run_trial(film, film.guiding.warm_up_round(terms(slot)), pass)) return false;
        film.guiding.measure_round(film.trial.guided, film.trial.baseline, terms(slot));
        film.trial = {};
    }
    inputs_.backend->reset_film(slot, inputs_.settings.width, inputs_.settings.height);
    return true;
}

/// Traces the rest of a trial's paths; the field learns from them at once. Returns false if it was stopped.
bool GuidedPasses::run_trial(FilmProgress& film, Trial trial, const PassRequest& pass) {
    const Stopwatch watch;
    const MethodId method = pass.slot.method;
    PassCounters& done = trial.is_guided ? film.trial.guided : film.trial.baseline;
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

/// Whether the paths of a trial train the field: guided ones, and in a warm-up those of the baseline, by the kernel of the method that
/// learns. The latter meet light that the field does not know as often as light that it knows.
bool GuidedPasses::trains_by(const FilmProgress& film, MethodId method, Trial trial) const {
    const bool is_training = trial.is_guided || film.guiding.is_warming_up();
    return is_training && info_of(method).learns && !fields_.is_frozen(method);
}

/// Paths of the warm-up come to the film, because later ones are measured against it; all others leave it as it is.
PassRequest GuidedPasses::trial_request(const FilmProgress& film, Trial trial, PassRequest request) const {
    const FilmSlot slot = request.slot;
    const bool is_warm_up = film.guiding.is_warming_up();
    request.is_guided = trial.is_guided || trains_by(film, slot.method, trial);
    if (!trial.is_guided) {
        request.path = path_settings(inputs_.settings, baseline_method());
        request.path.roulette = RouletteRule::Albedo;
        request.mixture = MixtureSettings::unguided();
    }
    request.path.stream = is_warm_up ? Stream::WarmUp : Stream::Trial;
    request.trains = !fields_.is_frozen(slot.method);
    // A small picture has few paths to spare beside its passes.
    request.subset.step = trial_step() * (trial.is_guided || warms_up(slot) ? 1 : 2);
    if (is_warm_up) {
        request.sample = film.guiding.rounds();
        request.passes = request.sample + 1;
        request.use = request.sample < kFewestBeforeVariance ? SampleUse::Film : SampleUse::Measured;
    } else {
        if (trial.passes > 0.0)
            request.subset.step = static_cast<std::uint32_t>(
                std::clamp(1.0 / trial.passes, 1.0, static_cast<double>(request.subset.step)));
        request.subset.phase = film.passes % request.subset.step;
        request.use = SampleUse::Trial;
    }
    return request;
}

void GuidedPasses::finish_pass(FilmSlot slot, FilmProgress& film) const {
    if (!chooses(slot)) return;
    if (!film.is_guided) ++film.unguided_passes;
    if (is_chosen_after(film.passes + 1)) film.guiding.measure_pass(film.passes, film.measured, terms(slot));
}

std::optional<GuidingStatus> GuidedPasses::status(FilmSlot slot, const FilmProgress& film) const {
    if (!chooses(slot)) return std::nullopt;
    return GuidingStatus{.pays = film.guiding.pays(),
                         .gain = film.guiding.gain(),
                         .unguided_passes = film.unguided_passes,
                         .trial_paths = film.trial_paths};
}

}  // namespace pl
