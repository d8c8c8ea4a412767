#include "ui/accuracy/headlines.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/measure/gain.h"

namespace pl {
namespace {

constexpr double kFewestSamples = 8.0;  ///< below, a pixel's noise is not yet known to itself

bool same_kind(const RunLabel& a, const RunLabel& b) {
    return a.method == b.method && a.backend == b.backend && a.next_event == b.next_event && a.warm == b.warm;
}

bool has_error(const LiveRun& run, ErrorMetric metric) {
    return std::ranges::any_of(run.points,
                               [&](const LivePoint& point) { return error_of(point, metric).has_value(); });
}

/// The last of its points at which the error was measured.
RunEnd last_point(const LiveRun& run, ErrorMetric metric) {
    RunEnd end;
    for (const LivePoint& point : run.points)
        if (const auto error = error_of(point, metric))
            end = {*error, cost_of(point, CostAxis::Samples), cost_of(point, CostAxis::Seconds)};
    return end;
}

/// The run as it was after so many seconds, or its last point if it was not measured around them.
RunEnd end_at(const LiveRun& run, ErrorMetric metric, double seconds) {
    const auto error = error_at(curve_of(run, {metric, CostAxis::Seconds}), seconds);
    const auto samples = error_at(other_cost_of(run, CostAxis::Seconds), seconds);
    return error && samples ? RunEnd{*error, *samples, seconds} : last_point(run, metric);
}

std::string sentence(const LiveRun& base, const LiveRun& run, ErrorMetric metric) {
    const CurveKind kind{metric, CostAxis::Seconds};
    const std::array<Curve, 2> curves{curve_of(base, kind), curve_of(run, kind)};
    // Both after the same time: what noise tells of itself changes while fireflies are still being found.
    const auto common = common_range(curves);
    const RunEnd base_end = common ? end_at(base, metric, common->last) : last_point(base, metric);
    const RunEnd run_end = common ? end_at(run, metric, common->last) : last_point(run, metric);
    if (std::min(base_end.samples, run_end.samples) < kFewestSamples)
        return fmt::format("{}: too few samples to compare yet", name_of(run.label));
    const Gain gain = gain_over({&base_end, 1}, {&run_end, 1}, {&curves[0], 1}, {&curves[1], 1});
    std::string text = fmt::format("{} {}", name_of(run.label), headline(gain, name_of(base.label)));
    if (metric == ErrorMetric::Noise) text += ". By their own noise: there is no reference";
    return text;
}

Headline headline_of(RunList runs, const LiveRun& run) {
    Headline result{run.number, color_of(run.label.method), {}};
    const auto base = base_of(runs, run);
    if (!base) {
        result.text = fmt::format("{} has nothing to be compared with yet: 1 renders default", name_of(run.label));
        return result;
    }
    for (const ErrorMetric metric : {ErrorMetric::RelMse, ErrorMetric::Noise})
        if (has_error(*base, metric) && has_error(run, metric)) {
            result.text = sentence(*base, run, metric);
            return result;
        }
    result.text = fmt::format("{}: too few samples to compare yet", name_of(run.label));
    return result;
}

}  // namespace

std::vector<Headline> make_headlines(RunList runs, std::uint64_t picture) {
    std::vector<const LiveRun*> newest;
    for (const auto& run : runs) {
        if (run->label.picture != picture || run->label.method == MethodId::Default || run->points.empty()) continue;
        std::erase_if(newest, [&](const LiveRun* other) { return same_kind(other->label, run->label); });
        newest.push_back(run.get());
    }
    std::vector<Headline> headlines;
    for (const LiveRun* run : newest) headlines.push_back(headline_of(runs, *run));
    if (headlines.empty())
        headlines.push_back({0, 0xff969ca6u, "Only default so far: 2 and 3 render with what was learned"});
    return headlines;
}

}  // namespace pl
