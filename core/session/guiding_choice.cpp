#include "core/session/guiding_choice.h"

#include <algorithm>
#include <cmath>

#include "core/kernel/film/sample_variance.h"

namespace pl {
namespace {

/// Rounds of the warm-up after which it may end: with a clear gain, with a loss, in any case.
constexpr std::uint32_t kRoundsForGain = kFewestBeforeVariance + 2;
constexpr std::uint32_t kRoundsForLoss = kFewestBeforeVariance + 4;
constexpr std::uint32_t kMostWarmUpRounds = kFewestBeforeVariance + 6;
constexpr double kClearGain = 1.5;
/// Gains below which guiding is given up by the warm-up, in the first passes, later, and above which it is taken up again. Below 1 at
/// first: fields still get better (docs/notebook/2026-11-24-warm-up.md).
constexpr double kLeastUnprovenGain = 0.65;
constexpr double kLeastEarlyGain = 0.8;
constexpr double kLeastGain = 0.9;
constexpr double kReturningGain = 1.0;
/// Rounds after which a field that another film interrupts is trusted.
constexpr std::uint32_t kRoundsOfTrust = 4;

/// Passes before which the baseline is measured in a film that had no warm-up, and first pass after which it decides.
constexpr std::uint32_t kFirstTrial = kFewestBeforeVariance;
constexpr std::uint32_t kSecondTrial = kFirstTrial + 2;
constexpr std::uint32_t kEarlyPasses = 16;
/// Weight of the guided passes before the newest one: their variances fall while a field learns, and are noisy.
constexpr double kKept = 0.8;

}  // namespace

PathCosts PathCosts::of(std::size_t triangles, FeatureSet features) {
    constexpr std::size_t kFewTriangles = 64;  // tested one by one
    PathCosts costs{.segment = triangles <= kFewTriangles ? 70.0 : 250.0, .guidance = 50.0};
    if (features.has(Feature::NextEventEstimation)) {
        costs.segment += features.has(Feature::ManyLights) ? 310.0 : 110.0;
        costs.guidance += 45.0;
    }
    if (features.has_any(kLobeFeatures)) {
        costs.segment += 150.0;
        costs.guidance += 110.0;
    }
    return costs;
}

double PathCosts::of_path(const PassCounters& counters) const {
    const PathCounters& path = counters.path;
    const bool is_guided = path.method.lookups > 0;
    const double work = static_cast<double>(path.segments) * (segment + (is_guided ? guidance : 0.0));
    return work / static_cast<double>(std::max<std::uint64_t>(counters.paths, 1));
}

void PathEfficiency::add(const PassCounters& counters, const PathCosts& costs) {
    const auto samples = static_cast<double>(counters.variance.samples);
    const auto paths = static_cast<double>(counters.paths);
    variance_ += counters.variance.mean() * samples;
    samples_ += samples;
    cost_ += costs.of_path(counters) * paths;
    paths_ += paths;
}

void PathEfficiency::fade(double share) {
    variance_ *= share;
    samples_ *= share;
    cost_ *= share;
    paths_ *= share;
}

Trial GuidingChoice::warm_up_round() const {
    return {.is_guided = true, .is_baseline = rounds_ >= kFewestBeforeVariance};
}

void GuidingChoice::measure_round(const PassCounters& guided, const PassCounters& baseline, const PathCosts& costs,
                                  double share) {
    ++rounds_;
    guided_.fade(kKept);
    guided_.add(guided, costs);
    baseline_.add(baseline, costs);
    predict();
    count_cost(share);
    if (baseline.paths > 0) spent_ += share;
    // Without a measurable variance of either the field is trusted: the baseline may have found no light at all.
    const double gain = gain_.value_or(1.0);
    if (rounds_ >= kRoundsForGain && gain >= kClearGain) belief_ = true;
    if (rounds_ >= kRoundsForLoss && gain < kLeastUnprovenGain) belief_ = false;
    if (rounds_ >= kMostWarmUpRounds) belief_ = gain >= kLeastUnprovenGain;
}

Trial GuidingChoice::trial_before(std::uint32_t pass) const {
    if (pass < kFewestBeforeVariance || last_trial_ == pass) return {};
    if (!pays()) return {.is_guided = spent_ + trial_cost_ <= kExploration * static_cast<double>(pass)};
    const bool is_due =
        (pass == kFirstTrial && baseline_trials_ == 0) || (pass == kSecondTrial && baseline_trials_ == 1);
    return {.is_baseline = is_due && rounds_ == 0};
}

void GuidingChoice::measure_trial(std::uint32_t pass, const PassCounters& guided, const PassCounters& baseline,
                                  const PathCosts& costs, double share) {
    last_trial_ = pass;
    baseline_.add(baseline, costs);
    if (baseline.paths > 0) ++baseline_trials_;
    if (guided.paths == 0) return;
    guided_.fade(kKept);
    guided_.add(guided, costs);
    predict();
    count_cost(share);
    decide(pass);
}

void GuidingChoice::count_cost(double share) {
    trial_cost_ = share * (baseline_.is_measured() ? guided_.cost() / baseline_.cost() : 1.0);
    spent_ += trial_cost_;
}

void GuidingChoice::measure_pass(std::uint32_t pass, const PassCounters& counters, const PathCosts& costs) {
    if (pass < kFewestBeforeVariance) return;
    if (pays()) guided_.fade(kKept);
    (pays() ? guided_ : baseline_).add(counters, costs);
    predict();
    if (pass > kSecondTrial) decide(pass);
}

void GuidingChoice::predict() {
    if (!guided_.is_measured() || !baseline_.is_measured()) return;
    const double gain = baseline_.variance() * baseline_.cost() / (guided_.variance() * guided_.cost());
    if (gain > 0.0 && std::isfinite(gain)) gain_ = gain;
}

void GuidingChoice::decide(std::uint32_t pass) {
    if (!gain_) return;
    const double least = pass < kEarlyPasses ? kLeastEarlyGain : kLeastGain;
    belief_ = *gain_ >= (pays() ? least : kReturningGain);
}

GuidingChoice GuidingChoice::restarted() const {
    GuidingChoice choice;
    choice.belief_ = belief_;
    if (rounds_ >= kRoundsOfTrust) choice.trust_field();
    return choice;
}

}  // namespace pl
