#include "core/session/guiding_choice.h"

#include <algorithm>
#include <cmath>

namespace pl {
namespace {

/// Paths by which a method is measured, at least where that takes no more than kMostPasses.
constexpr std::uint32_t kMeasuredPaths = 65536;
/// Passes of each role in the warm-up of a small picture.
constexpr std::uint32_t kMostPasses = 2;

/// Guidance by a table takes this part of a path's time on the shipped scenes; longer paths are extra.
constexpr double kPrice = 0.6;
/// After a warm-up guiding pays from this part of its price on, because fields go on learning. With a table that is a ratio of 1.36:
/// guided paths had at most 1.32 times less variance on the shipped scenes where guiding does not pay, and at least 1.42 times less on the
/// others (256 x 256, six seeds of 14 scenes). Later it has to pay its price (docs/notebook/2026-11-30-two-passes-ask.md).
constexpr double kLeastGain = 0.85;
/// Guiding pays, whatever the variances, where guided paths bring light so many times as often as paths of the baseline: the variance of
/// the baseline is then only the variance of the light that it has found. The ratio is 12 on labyrinth, 17 on staircase and 4.5 on
/// Veach Ajar, and at most 1.9 in five other rooms of the literature.
constexpr double kRatioOfHiddenLight = 2.0;

/// Quantile of the normal distribution at 97.5 %.
constexpr double kBoundErrors = 1.96;

}  // namespace

void PathNoise::add_paths(const PassCounters& counters) {
    const auto paths = static_cast<double>(counters.paths);
    lit_ += paths - static_cast<double>(counters.zero_contribution_paths);
    paths_ += paths;
}

void PathNoise::add_variance(double total, double squares, std::uint64_t samples) {
    variance_ += total;
    squares_ += squares;
    samples_ += static_cast<double>(samples);
}

void GuidingChoice::begin_film(std::uint32_t pixels, bool is_known) {
    if (is_known) belief_ = pays();
    const std::uint32_t each = std::clamp((kMeasuredPaths + pixels - 1) / pixels, 1u, kMostPasses);
    schedule_ = {.each = each, .warm_up = belief_ ? 0 : 2 * each};
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
    if (is_warm_up(pass)) return pass < each ? PassRole::Training : PassRole::Guided;
    const std::uint32_t since_question = schedule_.since_question(pass);
    if (since_question == 2 * each) return PassRole::None;
    return pays() == (since_question >= each) ? PassRole::Guided : PassRole::Baseline;
}

bool GuidingChoice::is_guided(std::uint32_t pass) const {
    const PassRole role = role_of(pass);
    return role == PassRole::Guided || (role == PassRole::None && pays());
}

VarianceMeasure GuidingChoice::measure_of(std::uint32_t pass) const {
    const PassRole role = role_of(pass);
    if (role == PassRole::None || role == PassRole::Training) return {};
    return {.is_any = true, .training = is_warm_up(pass) ? static_cast<std::int32_t>(schedule_.each) : 0};
}

void GuidingChoice::finish_pass(std::uint32_t pass, const PassCounters& counters, double guidance) {
    if (role_of(pass) == PassRole::None) return;
    PathNoise& own = is_guided(pass) ? guided_ : baseline_;
    using Sums = VarianceSums;
    const Sums& measured = counters.variance;
    own.add_paths(counters);
    own.add_variance(Sums::units_of(measured.sum), Sums::product_units_of(measured.squares), measured.samples);
    if (is_warm_up(pass) && is_guided(pass)) {
        baseline_.add_variance(Sums::units_of(measured.training_sum),
                               Sums::product_units_of(measured.training_squares), measured.samples);
        products_ += Sums::product_units_of(measured.products);
    }
    const std::uint32_t each = schedule_.each;
    const bool is_last =
        is_warm_up(pass) ? pass + 1 == schedule_.warm_up : schedule_.since_question(pass) + 1 == 2 * each;
    if (is_last) decide(least_ratio(guidance, is_warm_up(pass)), is_warm_up(pass));
}

/// In a warm-up both variances of a pixel hold the difference of the same two samples, and so err together; and all guided samples of
/// the pixel share its training samples, so that its measurements count once. The variances of a question come from passes of their own.
void GuidingChoice::measure_ratio(bool is_warm_up) {
    const double ratio = baseline_.variance() / guided_.variance();
    if (!(ratio > 0.0) || !std::isfinite(ratio)) return;
    const double samples = guided_.samples();
    const double of_means = guided_.variance() * baseline_.variance();
    const double covariance = is_warm_up ? (products_ / of_means - samples) / (samples * samples) : 0.0;
    const double squared = guided_.squared_error() + baseline_.squared_error() - 2.0 * covariance;
    const double shared = is_warm_up ? schedule_.each : 1.0;
    ratio_ = ratio;
    ratio_factor_ = std::exp(kBoundErrors * std::sqrt(std::max(shared * squared, 0.0)));
}

/// Without a measurable variance of either the belief stays: the baseline may have found no light at all.
void GuidingChoice::decide(double least_ratio, bool is_warm_up) {
    measure_ratio(is_warm_up);
    const bool is_hidden = guided_.is_measured() && baseline_.is_measured() &&
                           guided_.lit_share() > kRatioOfHiddenLight * baseline_.lit_share();
    belief_ = is_hidden || (ratio_ ? *ratio_ >= least_ratio : pays());
    guided_ = baseline_ = {};
    products_ = 0.0;
}

}  // namespace pl
