#include "ui/plot/run_gain.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace pl::ui {
namespace {

constexpr double kFewestSamples = 8.0;       ///< fewer are too few to estimate a pixel's noise
constexpr double kNormalQuantile = 1.95996;  ///< of 0.975: blocks are many

using Repetitions = std::vector<std::shared_ptr<const LiveRun>>;

/// The last point at which the error was measured; without samples if there is none.
RunEnd last_point(const LiveRun& run, ErrorMetric metric) {
    RunEnd end;
    for (const LivePoint& point : run.points)
        if (const auto error = error_of(point, metric))
            end = {*error, cost_of(point, CostAxis::Samples), cost_of(point, CostAxis::Seconds)};
    return end;
}

/// The run after so many seconds, or its last point if it was not measured around that time.
RunEnd end_at(const LiveRun& run, ErrorMetric metric, double seconds) {
    const auto error = error_at(curve_of(run, {metric, CostAxis::Seconds}), seconds);
    const auto samples = error_at(other_cost_of(run, CostAxis::Seconds), seconds);
    return error && samples ? RunEnd{*error, *samples, seconds} : last_point(run, metric);
}

double charged_until(const LiveRun& run) { return cost_of(run.points.back(), CostAxis::Seconds); }

/// Standard error of the logarithm of the error, over the blocks of the last picture; 0 if unknown.
double log_error_off(const LiveRun& run, ErrorMetric metric) {
    for (auto point = run.points.rbegin(); point != run.points.rend(); ++point)
        if (const auto error = error_of(*point, metric); error && *error > 0.0)
            return error_off(*point, metric) / *error;
    return 0.0;
}

/// All runs of one side, at the time of the comparison.
struct Side {
    std::vector<Curve> curves;
    std::vector<RunEnd> ends;

    bool has_enough_samples() const {
        return std::ranges::none_of(ends, [](const RunEnd& end) { return end.samples < kFewestSamples; });
    }
};

std::vector<Curve> curves_of(const Repetitions& runs, ErrorMetric metric) {
    std::vector<Curve> curves;
    for (const auto& run : runs) curves.push_back(curve_of(*run, {metric, CostAxis::Seconds}));
    return curves;
}

std::vector<RunEnd> ends_of(const Repetitions& runs, ErrorMetric metric, const std::optional<CostRange>& common) {
    std::vector<RunEnd> ends;
    for (const auto& run : runs)
        ends.push_back(common ? end_at(*run, metric, common->last) : last_point(*run, metric));
    return ends;
}

/// The runs of a baseline and of a method that are compared.
struct Sides {
    Side base;
    Side own;
    bool same_time = true;

    bool have_enough_samples() const { return base.has_enough_samples() && own.has_enough_samples(); }
};

/// Both after the same time: an estimate of noise keeps growing while fireflies are still being found. Each at its end if the shorter
/// run took so little time that the other had too few samples by then: it may be over, and waiting would bring nothing.
Sides sides_of(const Repetitions& base, const Repetitions& runs, ErrorMetric metric) {
    Sides sides{.base = {curves_of(base, metric), {}}, .own = {curves_of(runs, metric), {}}};
    std::vector<Curve> all = sides.base.curves;
    all.insert(all.end(), sides.own.curves.begin(), sides.own.curves.end());
    const auto take_ends = [&](const std::optional<CostRange>& common) {
        sides.base.ends = ends_of(base, metric, common);
        sides.own.ends = ends_of(runs, metric, common);
    };
    const auto common = common_range(all);
    take_ends(common);
    sides.same_time = common.has_value();
    if (sides.same_time && !sides.have_enough_samples()) {
        take_ends(std::nullopt);
        sides.same_time = false;
    }
    return sides;
}

RunLabel label_of_all(const Repetitions& runs) {
    RunLabel label = runs.back()->label;
    if (runs.size() > 1) label.seed = 0;
    return label;
}

/// Those that were measured with enough samples: one that is over before would keep all others from being compared.
Repetitions measured_repetitions(RunList runs, const LiveRun& like, ErrorMetric metric) {
    Repetitions repetitions = repetitions_of(runs, like);
    std::erase_if(repetitions, [&](const auto& run) { return last_point(*run, metric).samples < kFewestSamples; });
    return repetitions;
}

/// The interval of a ratio of single runs, as if the errors of both pictures were independent.
Interval block_interval(double ratio, double base_off, double off) {
    const double factor = std::exp(kNormalQuantile * std::hypot(base_off, off));
    return {ratio, ratio / factor, ratio * factor};
}

std::string block_text(const Interval& net) {
    return fmt::format(". Over the blocks of this picture alone 95 %: {:.2g} to {:.2g}; other seeds differ by more",
                       net.low, net.high);
}

std::optional<RunGain> gain_by(ErrorMetric metric, RunList runs, const LiveRun& base, const LiveRun& run) {
    const Repetitions base_runs = measured_repetitions(runs, base, metric);
    const Repetitions own_runs = measured_repetitions(runs, run, metric);
    if (base_runs.empty() || own_runs.empty()) return std::nullopt;
    const Sides sides = sides_of(base_runs, own_runs, metric);

    const Gain gain = gain_over(sides.base.ends, sides.own.ends, sides.base.curves, sides.own.curves);
    RunGain result{.net = {gain.net.value, 0.0, std::numeric_limits<double>::infinity()},
                   .sentence = fmt::format("{} {}", name_of(label_of_all(own_runs)),
                                           headline(gain, name_of(label_of_all(base_runs))))};
    if (gain.runs >= kFewestRuns) {
        result.net = gain.net;
        result.source = IntervalSource::Seeds;
    } else if (base_runs.size() == 1 && own_runs.size() == 1) {
        const double base_off = log_error_off(*base_runs[0], metric);
        const double off = log_error_off(*own_runs[0], metric);
        if (base_off > 0.0 && off > 0.0) {
            result.net = block_interval(gain.net.value, base_off, off);
            result.source = IntervalSource::Blocks;
            result.sentence += block_text(result.net);
        }
    }
    if (!sides.same_time) result.sentence += ". Each at its end: one ran too short to compare both after its time";
    if (metric == ErrorMetric::Noise) result.sentence += ". By their own noise: there is no reference for both";
    return result;
}

}  // namespace

bool are_repetitions(const RunLabel& a, const RunLabel& b) {
    return a.method == b.method && a.backend == b.backend && a.next_event == b.next_event && a.warm == b.warm &&
           a.picture == b.picture && a.details == b.details;
}

Repetitions repetitions_of(RunList runs, const LiveRun& like) {
    constexpr double kLeastShare = 0.5;
    Repetitions repetitions;
    double longest = 0.0;
    for (const auto& run : runs) {
        if (!are_repetitions(run->label, like.label) || run->points.empty()) continue;
        std::erase_if(repetitions, [&](const auto& other) { return other->label.seed == run->label.seed; });
        repetitions.push_back(run);
    }
    for (const auto& run : repetitions) longest = std::max(longest, charged_until(*run));
    std::erase_if(repetitions, [&](const auto& run) { return charged_until(*run) < kLeastShare * longest; });
    return repetitions;
}

std::optional<RunGain> gain_of_run(RunList runs, const LiveRun& base, const LiveRun& run) {
    for (const ErrorMetric metric : {ErrorMetric::RelMse, ErrorMetric::Noise})
        if (auto gain = gain_by(metric, runs, base, run)) return gain;
    return std::nullopt;
}

}  // namespace pl::ui
