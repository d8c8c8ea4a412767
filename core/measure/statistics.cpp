#include "core/measure/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include <fmt/format.h>

namespace pl {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Continued fraction of the incomplete beta function.   [Press et al., Numerical Recipes, 3rd ed., 6.4]
double beta_fraction(double a, double b, double x) {
    constexpr double kSmall = 1.0e-300;
    const auto safe = [](double v) { return std::fabs(v) < kSmall ? kSmall : v; };
    double c = 1.0;
    double d = 1.0 / safe(1.0 - (a + b) * x / (a + 1.0));
    double result = d;
    for (int m = 1; m <= 1000; ++m) {
        const double even = m * (b - m) * x / ((a + 2 * m - 1.0) * (a + 2 * m));
        d = 1.0 / safe(1.0 + even * d);
        c = safe(1.0 + even / c);
        result *= d * c;
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1.0));
        d = 1.0 / safe(1.0 + odd * d);
        c = safe(1.0 + odd / c);
        result *= d * c;
        if (std::fabs(d * c - 1.0) < 1.0e-15) break;
    }
    return result;
}

double incomplete_beta(double a, double b, double x) {
    if (x <= 0.0) return 0.0;
    if (x >= 1.0) return 1.0;
    const double front =
        std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x));
    return x < (a + 1.0) / (a + b + 2.0) ? front * beta_fraction(a, b, x) / a
                                         : 1.0 - front * beta_fraction(b, a, 1.0 - x) / b;
}

/// Probability that t with `freedom` degrees exceeds `t` >= 0.
double student_tail(double t, double freedom) {
    return 0.5 * incomplete_beta(0.5 * freedom, 0.5, freedom / (freedom + t * t));
}

struct MeanAndVariance {
    double n = 0.0;
    double mean = 0.0;
    double of_mean = 0.0;  ///< variance of the mean
};

MeanAndVariance summarize(std::span<const double> values) {
    MeanAndVariance result{.n = static_cast<double>(values.size())};
    for (const double value : values) result.mean += value;
    result.mean /= result.n;
    double squares = 0.0;
    for (const double value : values) squares += (value - result.mean) * (value - result.mean);
    result.of_mean = squares / (result.n - 1.0) / result.n;
    return result;
}

/// Logarithms of positive values, NaN for others.
std::vector<double> logarithms(std::span<const double> values) {
    std::vector<double> logs;
    for (const double value : values) logs.push_back(value > 0.0 ? std::log(value) : kNone);
    return logs;
}

Interval around(double value, double half_width) { return {value, value - half_width, value + half_width}; }

Interval exponential(const Interval& logs) { return {std::exp(logs.value), std::exp(logs.low), std::exp(logs.high)}; }

double two_sided_quantile(double freedom) { return student_quantile(0.5 + 0.5 * kConfidence, freedom); }

}  // namespace

std::string interval_text(const Interval& interval) {
    return fmt::format("{:.3g} ({:.3g} to {:.3g})", interval.value, interval.low, interval.high);
}

double student_quantile(double probability, double freedom) {
    const double tail = std::min(probability, 1.0 - probability);
    if (tail == 0.5) return 0.0;
    double low = 0.0;
    double high = 1.0;
    while (student_tail(high, freedom) > tail && high < 1.0e300) high *= 2.0;
    for (int i = 0; i < 200 && low < high; ++i) {
        const double middle = 0.5 * (low + high);
        if (middle == low || middle == high) break;
        (student_tail(middle, freedom) > tail ? low : high) = middle;
    }
    return probability > 0.5 ? high : -high;
}

Interval mean_interval(std::span<const double> values) {
    if (values.empty()) return {kNone, kNone, kNone};
    if (values.size() == 1) return around(values[0], kInfinite);
    const MeanAndVariance summary = summarize(values);
    return around(summary.mean, two_sided_quantile(summary.n - 1.0) * std::sqrt(summary.of_mean));
}

Interval geometric_interval(std::span<const double> values) { return exponential(mean_interval(logarithms(values))); }

Interval ratio_interval(std::span<const double> numerator, std::span<const double> denominator) {
    if (numerator.empty() || denominator.empty()) return {kNone, kNone, kNone};
    const MeanAndVariance a = summarize(logarithms(numerator));
    const MeanAndVariance b = summarize(logarithms(denominator));
    const double ratio = a.mean - b.mean;
    if (numerator.size() < 2 || denominator.size() < 2) return exponential(around(ratio, kInfinite));
    const double variance = a.of_mean + b.of_mean;
    if (!(variance > 0.0)) return exponential(around(ratio, 0.0));  // or NaN, as the ratio is
    // Satterthwaite's degrees of freedom.
    const double freedom =
        variance * variance / (a.of_mean * a.of_mean / (a.n - 1.0) + b.of_mean * b.of_mean / (b.n - 1.0));
    return exponential(around(ratio, two_sided_quantile(freedom) * std::sqrt(variance)));
}

double line_slope(std::span<const double> x, std::span<const double> y) {
    const std::size_t n = std::min(x.size(), y.size());
    if (n < 2) return kNone;
    const double mean_x = summarize(x.first(n)).mean;
    const double mean_y = summarize(y.first(n)).mean;
    double products = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        products += (x[i] - mean_x) * (y[i] - mean_y);
        squares += (x[i] - mean_x) * (x[i] - mean_x);
    }
    return squares > 0.0 ? products / squares : kNone;
}

double without_bias(const GroupFigure& figure, GroupSet groups) {
    return 2.0 * figure(groups) - 0.5 * (figure(groups & kEvenGroups) + figure(groups & kOddGroups));
}

Interval jackknife_interval(const GroupFigure& figure) {
    constexpr int kPairs = 16;
    std::array<double, kPairs> values{};
    for (int pair = 0; pair < kPairs; ++pair)
        values[static_cast<std::size_t>(pair)] = figure(kAllGroups & ~(3u << (2 * pair)));
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / kPairs;
    double squares = 0.0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    const double error = std::sqrt(squares * (kPairs - 1) / kPairs);
    const double half = student_quantile(0.5 + 0.5 * kConfidence, kPairs - 1) * error;
    const double value = figure(kAllGroups);
    return {value, value - half, value + half};
}

Interval jackknife_ratio(const GroupFigure& figure) {
    const Interval log = jackknife_interval([&](GroupSet set) { return std::log(figure(set)); });
    if (!std::isfinite(log.low) || !std::isfinite(log.high))
        return {figure(kAllGroups), 0.0, std::numeric_limits<double>::infinity()};
    return {std::exp(log.value), std::exp(log.low), std::exp(log.high)};
}

}  // namespace pl
