#include "tests/bench/gain_figures.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "core/measure/convergence.h"

namespace pl::benchmarks {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A length in samples per pixel, or in seconds if those are 0.
struct Length {
    std::uint32_t samples = 0;
    double seconds = 0.0;

    std::string name() const { return samples > 0 ? fmt::format("{}", samples) : fmt::format("{:g} s", seconds); }
};

const Checkpoint* point_at(const GainRun& run, std::uint32_t samples) {
    const auto found = std::find_if(run.points.begin(), run.points.end(),
                                    [&](const Checkpoint& point) { return point.samples == samples; });
    return found == run.points.end() ? nullptr : &*found;
}

double seconds_at(const GainRun& run, const Length& length) {
    if (length.samples == 0) return length.seconds;
    const Checkpoint* point = point_at(run, length.samples);
    return point != nullptr ? point->seconds : kNone;
}

/// Geometric mean of a number of each seed.
template <class Number>
Interval over_seeds(const std::vector<GainRun>& base, const std::vector<GainRun>& method, Number number) {
    std::vector<double> values;
    for (std::size_t i = 0; i < std::min(base.size(), method.size()); ++i)
        values.push_back(number(base[i], method[i]));
    return geometric_interval(values);
}

/// The quotient of two positive numbers, else NaN: two errors below the resolution of a reference make no gain.
double ratio(double numerator, double denominator) {
    return numerator > 0.0 && denominator > 0.0 ? numerator / denominator : kNone;
}

GainFigures figures_at(const std::vector<GainRun>& base, const std::vector<GainRun>& method, const Length& length) {
    GainFigures figures{.length = length.name()};
    for (std::size_t error = 0; error < kErrorNames.size(); ++error) {
        const auto at_base_time = [&](const GainRun& b, const GainRun& run) {
            return error_at_time(run, error, seconds_at(b, length));
        };
        figures.base_errors[error] =
            over_seeds(base, method, [&](const GainRun& b, const GainRun&) { return at_base_time(b, b); });
        figures.equal_time[error] = over_seeds(base, method, [&](const GainRun& b, const GainRun& m) {
            return ratio(at_base_time(b, b), at_base_time(b, m));
        });
        figures.equal_samples[error] = over_seeds(base, method, [&](const GainRun& b, const GainRun& m) {
            const Checkpoint* of_base = point_at(b, length.samples);
            const Checkpoint* of_method = point_at(m, length.samples);
            return of_base != nullptr && of_method != nullptr
                       ? ratio(of_base->errors[error], of_method->errors[error])
                       : kNone;
        });
    }
    figures.base_seconds =
        over_seeds(base, method, [&](const GainRun& b, const GainRun&) { return seconds_at(b, length); });
    figures.slowdown = over_seeds(base, method, [&](const GainRun& b, const GainRun& m) {
        return length.samples > 0 ? ratio(seconds_at(m, length), seconds_at(b, length)) : kNone;
    });
    return figures;
}

}  // namespace

double error_at_time(const GainRun& run, std::size_t error, double seconds) {
    Curve curve;
    for (const Checkpoint& point : run.points) curve.push_back({point.seconds, point.errors[error]});
    const CurvePoint& last = curve.back();
    if (seconds > last.cost) return last.cost > 0.0 ? last.error * last.cost / seconds : kNone;
    return error_at(curve, seconds).value_or(kNone);
}

std::vector<GainFigures> gain_figures(const std::vector<GainRun>& base, const std::vector<GainRun>& method,
                                      const RunLength& length) {
    std::vector<GainFigures> figures{figures_at(base, method, {.seconds = length.seconds})};
    for (const std::uint32_t samples : length.samples) figures.push_back(figures_at(base, method, {samples}));
    return figures;
}

}  // namespace pl::benchmarks
