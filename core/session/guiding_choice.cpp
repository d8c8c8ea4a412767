#include "core/session/guiding_choice.h"

#include <algorithm>
#include <cmath>

#include "core/fields/field_model.h"
#include "core/kernel/film/sample_variance.h"

namespace pl {
namespace {

/// Paths per volume that a field has learned from: until the first it proves nothing, from the second on it is known how good
/// it becomes. With 1000 volumes they are 12 and 40 trials of 16384 paths (docs/notebook/2026-11-25-choice-at-512.md).
constexpr double kYoung = 190.0;
constexpr double kMature = 640.0;
/// The least gains that are guided. Below 1 at first, since guided paths make a field better; above 1 in the end, since even numbers
/// take more noise from the baseline's first vertices than the variance of a sample shows (docs/notebook/2026-11-26-both-errors.md).
constexpr double kLeastGainOfYoung = 0.1;
constexpr double kLeastGainOfLearning = 0.9;
constexpr double kLeastGain = 1.04;
/// The least gain by both errors at which a coarse map guides: completing the map takes a few passes, and gains a fifth more.
constexpr double kLeastGainOfCoarse = 0.9;
/// The gain by both errors is at most so many times that by variance, which is the surer one: relative variances of small pictures, and of
/// few samples, are noisy.
constexpr double kMostOverGain = 1.1;
/// The gain from which on guiding is taken up again.
constexpr double kReturningGain = 1.1;
/// Whatever its gain, a field is learning fast while the variance of guided paths is below this share of its first measurement.
constexpr double kFallOfFastLearning = 0.75;

/// A field that is not mature goes on learning, whatever its gain, while the share of guided paths that bring light is as many times
/// that of the baseline. It is 12 on labyrinth and 17 on staircase, where the variance of the few paths of the baseline that have
/// found light tells nothing, and at most 1.1 where guiding does not pay.
constexpr double kRatioOfHiddenLight = 1.5;

/// Rounds of a warm-up by paths of the baseline, and of both kinds.
struct WarmUpRounds {
    std::uint32_t baseline, most;

    /// By its predicted gain a field that has learned from 6 rounds of the baseline is as good as one from 12 guided rounds; at equal
    /// time some scenes gain by it and some lose (docs/notebook/2026-11-27-unguided-warm-up.md). A map learns nothing: its rounds only
    /// measure, each method by two at most (docs/notebook/2026-11-27-coarse-map.md).
    static constexpr WarmUpRounds of(GuidingTerms::Field field) {
        if (field == GuidingTerms::Field::Learning) return {6, 12};
        return {kFewestBeforeVariance + 1, kFewestBeforeVariance + 3};
    }
    /// From it on the warm-up ends with a clear gain or loss, see loses_clearly().
    constexpr std::uint32_t first_choice() const { return baseline + 2; }
};
/// Guided rounds begin at once where fewer paths of the baseline bring light: they find the rest of it.
constexpr double kLeastLitShare = 0.25;
/// A clear loss in a warm-up: a gain by both errors below the first, of a field that has learned from so many paths per volume.
constexpr double kLeastGainOfWarmUp = 0.7;
constexpr double kLearnedBeforeLoss = 100.0;
/// Measurements of guided paths until the variance that later ones are compared to.
constexpr std::uint32_t kMeasurementsOfFirstVariance = 5;
/// Rounds after which a field that another film interrupts is trusted.
constexpr std::uint32_t kRoundsOfTrust = 4;

/// Passes before which the baseline is measured in every film. It decides first after the pass that follows the second of them, or
/// after the pass behind the first if a warm-up has measured the baseline before.
constexpr std::uint32_t kFirstTrial = kFewestBeforeVariance;
constexpr std::uint32_t kSecondTrial = kFirstTrial + 2;
/// Where a warm-up has given up guiding, guided paths get a second look before this pass, by this share of a pass: the few that it had
/// may have been bright by chance.
constexpr std::uint32_t kSecondLook = 4;
constexpr double kPassesOfSecondLook = 0.15;
/// Number of a pass before which a trial of guided paths may be over that of the last one.
constexpr double kTrialSpacing = 1.25;
/// Samples of the baseline that tell its variance well enough.
constexpr double kEnoughSamples = 131072.0;
/// Weight of the guided passes before the newest one: their variances fall while a field learns, and are noisy.
constexpr double kKept = 0.8;

/// Time of guidance by a field that is constant, over that by one that learns.
constexpr double kGuidanceWithoutLearning = 0.65;

}  // namespace

PathCosts PathCosts::of(std::size_t triangles, FeatureSet features, Representation representation, bool learns) {
    constexpr std::size_t kFewTriangles = 64;  // tested one by one
    const bool has_few = triangles <= kFewTriangles;
    PathCosts costs{.segment = has_few ? 25.0 : 90.0, .guidance = has_few ? 45.0 : 60.0};
    if (features.has(Feature::NextEventEstimation)) {
        costs.segment += has_few ? 30.0 : 60.0;
        costs.guidance += 10.0;
        if (features.has(Feature::ManyLights)) {
            costs.segment += 90.0;
            costs.guidance += 30.0;
        }
    }
    if (features.has_any(kLobeFeatures)) {
        costs.segment += 60.0;
        costs.guidance += 25.0;
    }
    costs.guidance *= guidance_of(representation) * (learns ? 1.0 : kGuidanceWithoutLearning);
    return costs;
}

void PathEfficiency::add(const PassCounters& counters, double segment_cost) {
    const auto samples = static_cast<double>(counters.variance.samples);
    const auto paths = static_cast<double>(counters.paths);
    variance_ += counters.variance.mean() * samples;
    relative_ += counters.variance.relative_mean() * samples;
    samples_ += samples;
    cost_ += segment_cost * static_cast<double>(counters.path.segments);
    paths_ += paths;
    lit_ += paths - static_cast<double>(counters.zero_contribution_paths);
}

void PathEfficiency::fade(double share) {
    variance_ *= share;
    relative_ *= share;
    samples_ *= share;
    cost_ *= share;
    paths_ *= share;
    lit_ *= share;
}

Trial GuidingChoice::warm_up_round(const GuidingTerms& terms) const {
    const bool is_dark = baseline_.is_measured() && baseline_.lit_share() < kLeastLitShare;
    const bool is_guided = is_dark || rounds_ >= WarmUpRounds::of(terms.field).baseline;
    return {.is_guided = is_guided, .is_baseline = !is_guided};
}

void GuidingChoice::measure_round(const PassCounters& guided, const PassCounters& baseline,
                                  const GuidingTerms& terms) {
    ++rounds_;
    learn(guided.paths + baseline.paths, terms);
    if (baseline.variance.samples > 0) baseline_.add(baseline, terms.costs.segment);
    if (guided.paths > 0) measure_guided(guided, terms);
    spend(guided, baseline, terms);
    if (guided.paths == 0) return;
    predict();
    const WarmUpRounds rounds = WarmUpRounds::of(terms.field);
    // Without a measurable variance of either the field is trusted: the baseline may have found no light at all.
    const bool is_coarse = terms.field == GuidingTerms::Field::Coarse;
    const double gain = gain_ && is_coarse ? gain_of_both_ : gain_.value_or(kLeastGain);
    const double least = least_gain(terms);
    // Where light is hidden a young field has not yet met its own rare bright paths, whatever its gain.
    const bool is_clear =
        rounds_ >= rounds.first_choice() && gain >= std::max(least, kLeastGainOfLearning) && !finds_hidden_light();
    if (is_clear || rounds_ >= rounds.most)
        belief_ = gain >= least;
    else if (rounds_ >= rounds.first_choice() && loses_clearly())
        belief_ = false;
    found_hidden_light_ = belief_.value_or(false) && finds_hidden_light();
}

bool GuidingChoice::loses_clearly() const {
    return gain_ && learned_ >= kLearnedBeforeLoss && gain_of_both_ < kLeastGainOfWarmUp && !finds_hidden_light();
}

Trial GuidingChoice::trial_before(std::uint32_t pass) const {
    if (pass < kFewestBeforeVariance || last_trial_ == pass) return {};
    const bool is_first =
        (pass == kFirstTrial && baseline_trials_ == 0) || (pass == kSecondTrial && baseline_trials_ == 1);
    const bool is_affordable = spent_ + trial_cost_ <= kExploration * static_cast<double>(pass);
    if (!pays()) {
        if (takes_second_look()) return {.is_guided = pass >= kSecondLook, .passes = kPassesOfSecondLook};
        const bool is_due = is_affordable && (!last_trial_ || pass >= kTrialSpacing * *last_trial_);
        const double passes = (kExploration * static_cast<double>(pass) - spent_) / guided_cost();
        return is_due ? Trial{.is_guided = true, .passes = passes} : Trial{};
    }
    const bool is_further = pass > kSecondTrial && is_affordable && baseline_.samples() < kEnoughSamples;
    return {.is_baseline = is_first || is_further};
}

void GuidingChoice::measure_trial(std::uint32_t pass, const PassCounters& guided, const PassCounters& baseline,
                                  const GuidingTerms& terms) {
    if (takes_second_look()) guided_ = {};
    last_trial_ = pass;
    if (baseline.paths > 0) ++baseline_trials_;
    baseline_.add(baseline, terms.costs.segment);
    if (guided.paths > 0) {
        learn(guided.paths, terms);
        measure_guided(guided, terms);
    }
    spend(guided, baseline, terms);
    predict();
    if (!pays() || decides_after(pass - 1)) decide(terms);
}

void GuidingChoice::measure_pass(std::uint32_t pass, const PassCounters& counters, const GuidingTerms& terms) {
    if (pays()) learn(counters.paths, terms);
    if (pass < kFewestBeforeVariance) return;
    if (pays())
        measure_guided(counters, terms);
    else
        baseline_.add(counters, terms.costs.segment);
    predict();
    if (decides_after(pass)) decide(terms);
}

void GuidingChoice::measure_guided(const PassCounters& counters, const GuidingTerms& terms) {
    guided_.fade(kKept);
    guided_.add(counters, terms.costs.guided_segment());
    if (!first_variance_ && ++guided_measurements_ >= kMeasurementsOfFirstVariance && guided_.is_measured())
        first_variance_ = guided_.variance();
}

void GuidingChoice::spend(const PassCounters& guided, const PassCounters& baseline, const GuidingTerms& terms) {
    trial_cost_ =
        (static_cast<double>(guided.paths) * guided_cost() + static_cast<double>(baseline.paths)) / terms.pixels;
    spent_ += trial_cost_;
}

double GuidingChoice::guided_cost() const {
    return guided_.is_measured() && baseline_.is_measured() ? guided_.cost() / baseline_.cost() : 1.0;
}

void GuidingChoice::learn(std::uint64_t paths, const GuidingTerms& terms) {
    switch (terms.field) {
    case GuidingTerms::Field::Learning: learned_ += static_cast<double>(paths) / terms.volumes; break;
    case GuidingTerms::Field::Coarse: break;
    case GuidingTerms::Field::Complete: learned_ = std::max(learned_, kMature); break;
    }
}

void GuidingChoice::predict() {
    if (!guided_.is_measured() || !baseline_.is_measured()) return;
    const double costs = baseline_.cost() / guided_.cost();
    const double gain = costs * baseline_.variance() / guided_.variance();
    if (!(gain > 0.0) || !std::isfinite(gain)) return;
    gain_ = gain;
    const double relative = costs * baseline_.relative_variance() / guided_.relative_variance();
    const bool is_known = relative > 0.0 && std::isfinite(relative);
    gain_of_both_ = is_known ? std::min(std::sqrt(gain * relative), kMostOverGain * gain) : gain;
}

bool GuidingChoice::finds_hidden_light() const {
    return guided_.is_measured() && baseline_.is_measured() &&
           guided_.lit_share() > kRatioOfHiddenLight * baseline_.lit_share();
}

double GuidingChoice::least_gain(const GuidingTerms& terms) const {
    if (terms.field == GuidingTerms::Field::Coarse) return kLeastGainOfCoarse;
    if (learned_ >= kMature) return kLeastGain;
    const bool is_fast = first_variance_ && guided_.variance() < kFallOfFastLearning * *first_variance_;
    const bool is_open = learned_ < kYoung || is_fast || finds_hidden_light();
    return is_open ? kLeastGainOfYoung : kLeastGainOfLearning;
}

bool GuidingChoice::takes_second_look() const { return !pays() && rounds_ > 0 && !last_trial_; }

bool GuidingChoice::decides_after(std::uint32_t pass) const {
    return pass >= (rounds_ > 0 ? kFirstTrial : kSecondTrial + 1);
}

void GuidingChoice::decide(const GuidingTerms& terms) {
    // A field that is still learning is given up for variance alone: relative variances need means of many samples.
    const double gain = learned_ >= kMature ? gain_of_both_ : gain_.value_or(0.0);
    if (gain_) belief_ = gain >= (pays() || finds_hidden_light() ? least_gain(terms) : kReturningGain);
}

void GuidingChoice::trust_field() {
    begin_guided();
    learned_ = std::max(learned_, kMature);
}

GuidingChoice GuidingChoice::restarted() const {
    GuidingChoice choice;
    choice.belief_ = belief_;
    choice.learned_ = learned_;
    if (rounds_ >= kRoundsOfTrust) choice.begin_guided();
    return choice;
}

}  // namespace pl
