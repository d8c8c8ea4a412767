#include "core/session/guiding_choice.h"

#include <cmath>

namespace pl {
namespace {

/// Guidance by a table takes this part of a path's time on the shipped scenes; longer paths are extra.
constexpr double kPrice = 0.6;
/// Guiding pays from this part of its price on, because fields go on learning. With a table that is a ratio of 1.28: after
/// a warm-up guided paths had at most 1.27 times less variance on the shipped scenes where guiding does not pay, and at least 1.37 times
/// less on the others (256 x 256, six seeds of ten scenes, docs/notebook/2026-11-29-one-ratio.md): a seed may cross it on `still-life`.
constexpr double kLeastGain = 0.8;
/// Guiding pays, whatever the variances, where guided paths bring light so many times as often as paths of the baseline: the variance of
/// the baseline is then only the variance of the light that it has found. The ratio is 12 on labyrinth, 17 on staircase and 4.5 on Veach Ajar, and at most 1.9 in five other rooms of
/// the literature.
constexpr double kRatioOfHiddenLight = 2.0;

/// Rounds of a warm-up before it make the means.
constexpr std::uint32_t kFirstMeasuredRound = GuidingChoice::kDecision - GuidingChoice::kMeasured;

}  // namespace

void PathNoise::add(const PassCounters& counters) {
    const auto paths = static_cast<double>(counters.paths);
    variance_ += counters.variance.mean() * static_cast<double>(counters.variance.samples);
    samples_ += static_cast<double>(counters.variance.samples);
    lit_ += paths - static_cast<double>(counters.zero_contribution_paths);
    paths_ += paths;
}

double GuidingChoice::least_ratio(double guidance) { return kLeastGain * (1.0 + kPrice * guidance); }

Trial GuidingChoice::warm_up_trial() const {
    const bool is_baseline = !is_round_measured() || (warm_up_trials_ - kFirstMeasuredRound) % 2 == 0;
    return is_baseline ? Trial::Baseline : Trial::Guided;
}

std::uint32_t GuidingChoice::warm_up_round() const {
    return warm_up_trials_ < kFirstMeasuredRound ? warm_up_trials_
                                                 : kFirstMeasuredRound + (warm_up_trials_ - kFirstMeasuredRound) / 2;
}

void GuidingChoice::measure_warm_up(const PassCounters& counters, double least_ratio) {
    if (is_round_measured()) (warm_up_trial() == Trial::Guided ? guided_ : baseline_).add(counters);
    ++warm_up_trials_;
    if (warm_up_round() < kDecision) return;
    found_hidden_light_ = finds_hidden_light();
    decide(least_ratio);
    if (!pays()) decision_ = kLateDecision;
}

Trial GuidingChoice::trial_before(std::uint32_t pass) const {
    if (!is_measured(pass) || last_trial_ == pass) return Trial::None;
    return pays() ? Trial::Baseline : Trial::Guided;
}

void GuidingChoice::measure_trial(std::uint32_t pass, const PassCounters& counters) {
    last_trial_ = pass;
    (pays() ? baseline_ : guided_).add(counters);
}

void GuidingChoice::measure_pass(std::uint32_t pass, const PassCounters& counters, double least_ratio) {
    (pays() ? guided_ : baseline_).add(counters);
    if (pass + 1 == decision_) decide(least_ratio);
}

bool GuidingChoice::finds_hidden_light() const {
    return guided_.is_measured() && baseline_.is_measured() &&
           guided_.lit_share() > kRatioOfHiddenLight * baseline_.lit_share();
}

/// Without a measurable variance of either the belief stays: the baseline may have found no light at all.
void GuidingChoice::decide(double least_ratio) {
    const double ratio = baseline_.variance() / guided_.variance();
    if (ratio > 0.0 && std::isfinite(ratio)) ratio_ = ratio;
    belief_ = finds_hidden_light() || (ratio_ ? *ratio_ >= least_ratio : pays());
    guided_ = baseline_ = {};
}

GuidingChoice GuidingChoice::restarted() const {
    GuidingChoice choice;
    choice.belief_ = belief_;
    // A warm-up that another film interrupts has trained the field: it is not begun again.
    if (is_round_measured()) choice.begin_guided();
    return choice;
}

}  // namespace pl
