#include "core/session/guiding_choice.h"

#include <algorithm>
#include <cmath>

namespace pl {
namespace {

/// Paths by which a method is measured, at least where that takes no more than kMostPasses.
constexpr std::uint32_t kMeasuredPaths = 65536;
/// Passes of each role in the warm-up of a small picture.
constexpr std::uint32_t kMostPasses = 4;

/// Guidance by a table takes this part of a path's time on the shipped scenes; longer paths are extra.
constexpr double kPrice = 0.6;
/// After a warm-up guiding pays from this part of its price on, because fields go on learning. With a table that is a ratio of 1.28:
/// guided paths had at most 1.23 times less variance on the shipped scenes where guiding does not pay, but for one seed of `bar`, and at least
/// 1.44 times less on the others (256 x 256, six seeds of 14 scenes). Later it has to pay its price: after 64 passes of 96 x 96 pixels the ratios
/// were at most 1.52 and at least 2.14 (docs/notebook/2026-11-30-all-passes-stay.md).
constexpr double kLeastGain = 0.8;
/// Guiding pays, whatever the variances, where guided paths bring light so many times as often as paths of the baseline: the variance of
/// the baseline is then only the variance of the light that it has found. The ratio is 12 on labyrinth, 17 on staircase and 4.5 on Veach Ajar, and at most 1.9 in five other rooms of
/// the literature.
constexpr double kRatioOfHiddenLight = 2.0;

}  // namespace

void PathNoise::add(const PassCounters& counters) {
    const auto paths = static_cast<double>(counters.paths);
    variance_ += counters.variance.mean() * static_cast<double>(counters.variance.samples);
    samples_ += static_cast<double>(counters.variance.samples);
    lit_ += paths - static_cast<double>(counters.zero_contribution_paths);
    paths_ += paths;
}

void GuidingChoice::begin_film(std::uint32_t pixels, bool is_known) {
    if (is_known) belief_ = pays();
    const std::uint32_t each = std::clamp((kMeasuredPaths + pixels - 1) / pixels, 1u, kMostPasses);
    schedule_ = {.each = each, .warm_up = belief_ ? 0 : 3 * each};
}

GuidingChoice GuidingChoice::restarted() const {
    GuidingChoice choice;
    choice.belief_ = belief_;
    return choice;
}

double GuidingChoice::least_ratio(double guidance, bool is_warm_up) {
    return (is_warm_up ? kLeastGain : 1.0) * (1.0 + kPrice * guidance);
}

PassRole GuidingChoice::role_of(std::uint32_t pass) const {
    const std::uint32_t each = schedule_.each;
    if (is_warm_up(pass)) {
        constexpr PassRole kRoles[] = {PassRole::Training, PassRole::Baseline, PassRole::Guided};
        return kRoles[pass / each];
    }
    const std::uint32_t since_question = schedule_.since_question(pass);
    if (since_question == 2 * each) return PassRole::None;
    return pays() == (since_question >= each) ? PassRole::Guided : PassRole::Baseline;
}

bool GuidingChoice::is_guided(std::uint32_t pass) const {
    const PassRole role = role_of(pass);
    return role == PassRole::Guided || (role == PassRole::None && pays());
}

/// In a warm-up both methods are measured against training samples: about four of them, of one pixel or a block. Guided passes of the
/// same half as these would be measured against samples of the baseline and of one another.
MeanBlock GuidingChoice::block_of(std::uint32_t pass) const {
    const PassRole role = role_of(pass);
    if (!is_warm_up(pass)) return {role == PassRole::None ? 0u : 1u};
    const bool is_measured = role == PassRole::Baseline || (role == PassRole::Guided && pass % 2 == 0);
    return {!is_measured ? 0u : schedule_.each < kMostPasses ? MeanBlock::kMostPixels : 1u};
}

void GuidingChoice::finish_pass(std::uint32_t pass, const PassCounters& counters, double guidance) {
    if (block_of(pass).is_measured()) (is_guided(pass) ? guided_ : baseline_).add(counters);
    const std::uint32_t each = schedule_.each;
    const bool is_last =
        is_warm_up(pass) ? pass + 1 == schedule_.warm_up : schedule_.since_question(pass) + 1 == 2 * each;
    if (is_last) decide(least_ratio(guidance, is_warm_up(pass)));
}

/// Without a measurable variance of either the belief stays: the baseline may have found no light at all.
void GuidingChoice::decide(double least_ratio) {
    const double ratio = baseline_.variance() / guided_.variance();
    if (ratio > 0.0 && std::isfinite(ratio)) ratio_ = ratio;
    const bool is_hidden = guided_.is_measured() && baseline_.is_measured() &&
                           guided_.lit_share() > kRatioOfHiddenLight * baseline_.lit_share();
    belief_ = is_hidden || (ratio_ ? *ratio_ >= least_ratio : pays());
    guided_ = baseline_ = {};
}

}  // namespace pl
