#include "core/measure/gain.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace pl {
namespace {

template <class Number>
std::vector<double> numbers_of(std::span<const RunEnd> runs, Number number) {
    std::vector<double> values;
    for (const RunEnd& run : runs) values.push_back(number(run));
    return values;
}

/// The time from which on the mean error of `method` stays below that of `base`.
std::optional<double> ahead_from(std::span<const Curve> base, std::span<const Curve> method, const CostRange& range) {
    std::optional<double> since;
    const std::vector<double> times = log_spaced(range.first, range.last, 200);
    for (auto time = times.rbegin(); time != times.rend(); ++time) {
        const auto b = error_interval_at(base, *time);
        const auto m = error_interval_at(method, *time);
        if (!b || !m || !(m->value < b->value)) break;
        since = *time;
    }
    return since;
}

/// "3.4x", with the significant digits of the ratio.
std::string times(double ratio) {
    return ratio < 9.95 ? fmt::format("{:.1f}x", ratio) : fmt::format("{:.0f}x", ratio);
}

std::string either(double ratio, const char* above, const char* below) {
    return ratio >= 1.0 ? fmt::format("{} {}", times(ratio), above) : fmt::format("{} {}", times(1.0 / ratio), below);
}

std::string interval_text(const Interval& net) {
    const bool faster = net.value >= 1.0;
    const double low = faster ? net.low : 1.0 / net.high;
    const double high = faster ? net.high : 1.0 / net.low;
    return fmt::format("{:.2g} to {:.2g}", low, high);
}

}  // namespace

Gain gain_over(std::span<const RunEnd> base, std::span<const RunEnd> method, std::span<const Curve> base_curves,
               std::span<const Curve> method_curves) {
    const auto ratio = [&](auto number) {
        return ratio_interval(numbers_of(base, number), numbers_of(method, number));
    };
    Gain gain{.samples = ratio([](const RunEnd& run) { return run.error_samples(); }),
              .cost = ratio([](const RunEnd& run) { return run.seconds / run.samples; }),
              .net = ratio([](const RunEnd& run) { return run.error_seconds(); }),
              .runs = std::min(base.size(), method.size()),
              .ahead_from_seconds = {}};
    std::vector<Curve> both(base_curves.begin(), base_curves.end());
    both.insert(both.end(), method_curves.begin(), method_curves.end());
    if (const auto range = common_range(both)) {
        gain.ahead_from_seconds = ahead_from(base_curves, method_curves, *range);
        gain.compared_until_seconds = range->last;
    }
    return gain;
}

bool is_decided(const Interval& ratio) {
    return std::isfinite(ratio.low) && std::isfinite(ratio.high) && !ratio.contains(1.0);
}

std::string headline(const Gain& gain, const std::string& base_name) {
    if (!std::isfinite(gain.net.value))
        return fmt::format("cannot be compared with {}: an error is below what the reference resolves", base_name);
    std::string text = fmt::format(
        "needs {} samples than {}, each costs {}: {} to the same error", either(gain.samples.value, "fewer", "more"),
        base_name, either(gain.cost.value, "less", "more"), either(gain.net.value, "faster", "slower"));
    if (gain.runs == 1)
        text += " (one run each: no interval)";
    else if (gain.runs < kFewestRuns)
        text += fmt::format(" (only {} runs: no interval)", gain.runs);
    else
        text += fmt::format(" (95 %: {}{})", interval_text(gain.net), is_decided(gain.net) ? "" : ", so undecided");
    if (gain.ahead_from_seconds)
        text += fmt::format(", ahead from {:.2g} s on", *gain.ahead_from_seconds);
    else if (gain.compared_until_seconds > 0.0)
        text += fmt::format(", not ahead at {:.2g} s", gain.compared_until_seconds);
    return text;
}

std::vector<double> log_spaced(double first, double last, int count) {
    std::vector<double> values;
    for (int i = 0; i < count; ++i)
        values.push_back(first * std::pow(last / first, static_cast<double>(i) / std::max(count - 1, 1)));
    if (!values.empty()) values.back() = last;  // rounding must not step outside
    return values;
}

std::optional<CostRange> common_range(std::span<const Curve> runs) {
    CostRange range{0.0, std::numeric_limits<double>::infinity()};
    for (const Curve& run : runs) {
        if (run.empty()) return std::nullopt;
        range.first = std::max(range.first, run.front().cost);
        range.last = std::min(range.last, run.back().cost);
    }
    if (runs.empty() || !(range.first > 0.0) || !(range.first < range.last)) return std::nullopt;
    return range;
}

}  // namespace pl
