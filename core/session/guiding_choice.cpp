#include "core/session/guiding_choice.h"

#include <algorithm>
#include <limits>

namespace pl {
namespace {

/// Passes before which the two trials run. The estimator of the variance needs earlier ones.
constexpr std::uint32_t kFirstTrial = kFewestBeforeVariance;
constexpr std::uint32_t kSecondTrial = kFirstTrial + 2;
/// First pass after which guiding may be given up: the field has learned a little, and a few passes are measured. Two passes
/// earlier saves 1 % of 128 passes, but gives up fields that would have paid (docs/notebook/2026-11-23-guiding-choice.md).
constexpr std::uint32_t kFirstDecision = kSecondTrial + 1;
/// Weight of the guided passes before the newest one: their variances fall while a field learns, and are noisy.
constexpr double kKept = 0.8;
/// Gain below which guiding is given up, early and later, and above which it is taken up again. Below 1 at first: fields still
/// get better.
constexpr double kLeastEarlyGain = 0.8;
constexpr std::uint32_t kEarlyPasses = 16;
constexpr double kLeastGain = 0.9;
constexpr double kReturningGain = 1.0;

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

bool GuidingChoice::is_trial_due(std::uint32_t pass) const {
    return (pass == kFirstTrial && trials_ == 0) || (pass == kSecondTrial && trials_ == 1);
}

bool GuidingChoice::guides(std::uint32_t pass) const {
    return pays_ || lost_ + loss_per_pass_ <= kExploration * static_cast<double>(pass);
}

void GuidingChoice::measure_trial(const PassCounters& trial) {
    baseline_ += trial;
    ++trials_;
}

void GuidingChoice::measure_guided(std::uint32_t pass, const PassCounters& counters, const PathCosts& costs) {
    if (trials_ == 0) return;
    variance_ = kKept * variance_ + counters.variance.mean();
    cost_ = kKept * cost_ + costs.of_path(counters);
    weight_ = kKept * weight_ + 1.0;
    lost_ += loss_per_pass_;
    if (pass < kFirstDecision) return;
    const double variance_ratio = variance_ / (weight_ * baseline_.variance.mean());
    const double cost_ratio = cost_ / (weight_ * costs.of_path(baseline_));
    if (!(variance_ratio > 0.0) || !(variance_ratio * cost_ratio < std::numeric_limits<double>::infinity())) return;
    gain_ = 1.0 / (variance_ratio * cost_ratio);
    // By a guided pass among many others the variance of the mean times its cost grows by as many of them.
    const double loss = std::max(variance_ratio + cost_ratio - 2.0, 0.0);
    if (loss_per_pass_ == 0.0 && lost_ == 0.0) lost_ = loss * static_cast<double>(pass);
    loss_per_pass_ = loss;
    const double least = pass < kEarlyPasses ? kLeastEarlyGain : kLeastGain;
    pays_ = *gain_ >= (pays_ ? least : kReturningGain);
}

}  // namespace pl
