#include "ui/plot/headlines.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/measure/gain.h"
#include "ui/draw/method_keys.h"

namespace pl {
namespace {

constexpr double kFewestSamples = 8.0;  ///< fewer are too few to estimate a pixel's noise

bool same_kind(const RunLabel& a, const RunLabel& b) {
    return a.method == b.method && a.backend == b.backend && a.next_event == b.next_event && a.warm == b.warm;
}

bool has_error(const LiveRun& run, ErrorMetric metric) {
    return std::ranges::any_of(run.points,
                               [&](const LivePoint& point) { return error_of(point, metric).has_value(); });
}

/// The last point at which the error was measured.
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

/// Runs that differ only in their seeds.
using Repeats = std::vector<std::shared_ptr<const LiveRun>>;

double charged_until(const LiveRun& run) { return cost_of(run.points.back(), CostAxis::Seconds); }

/// The newest run like this one for each seed, if it was measured for at least half as long as the longest of them: one
/// that has just begun would shorten all others.
Repeats repeats_of(RunList runs, const LiveRun& like, ErrorMetric metric) {
    constexpr double kLeastShare = 0.5;
    Repeats repeats;
    double longest = 0.0;
    for (const auto& run : runs) {
        const bool is_repeat = same_kind(run->label, like.label) && run->label.picture == like.label.picture &&
                               run->label.details == like.label.details;
        if (!is_repeat || !has_error(*run, metric)) continue;
        std::erase_if(repeats, [&](const auto& other) { return other->label.seed == run->label.seed; });
        repeats.push_back(run);
    }
    for (const auto& run : repeats) longest = std::max(longest, charged_until(*run));
    std::erase_if(repeats, [&](const auto& run) { return charged_until(*run) < kLeastShare * longest; });
    return repeats;
}

std::vector<Curve> curves_of(const Repeats& repeats, ErrorMetric metric) {
    std::vector<Curve> curves;
    for (const auto& run : repeats) curves.push_back(curve_of(*run, {metric, CostAxis::Seconds}));
    return curves;
}

std::vector<RunEnd> ends_of(const Repeats& repeats, ErrorMetric metric, const std::optional<CostRange>& common) {
    std::vector<RunEnd> ends;
    for (const auto& run : repeats)
        ends.push_back(common ? end_at(*run, metric, common->last) : last_point(*run, metric));
    return ends;
}

std::string sentence(const Repeats& base, const Repeats& repeats, const LiveRun& run, ErrorMetric metric) {
    const std::vector<Curve> base_curves = curves_of(base, metric);
    const std::vector<Curve> curves = curves_of(repeats, metric);
    std::vector<Curve> all = base_curves;
    all.insert(all.end(), curves.begin(), curves.end());
    // All after the same time: an estimate of noise keeps growing while fireflies are still being found.
    const auto common = common_range(all);
    const std::vector<RunEnd> base_ends = ends_of(base, metric, common);
    const std::vector<RunEnd> ends = ends_of(repeats, metric, common);
    const auto is_short = [](const RunEnd& end) { return end.samples < kFewestSamples; };
    RunLabel named = run.label;
    if (repeats.size() > 1) named.seed = 0;
    if (std::ranges::any_of(base_ends, is_short) || std::ranges::any_of(ends, is_short))
        return fmt::format("{}: too few samples to compare yet", name_of(named));
    RunLabel base_named = base.back()->label;
    if (base.size() > 1) base_named.seed = 0;
    const Gain gain = gain_over(base_ends, ends, base_curves, curves);
    std::string text = fmt::format("{} {}", name_of(named), headline(gain, name_of(base_named)));
    if (metric == ErrorMetric::Noise) text += ". By their own noise: there is no reference";
    return text;
}

Headline headline_of(RunList runs, const LiveRun& run) {
    Headline result{run.number, info_of(run.label.method).color, {}};
    const auto base = base_of(runs, run);
    if (!base) {
        result.text = fmt::format("{} has nothing to be compared with yet: {} renders {}", name_of(run.label),
                                  info_of(baseline_method()).key, info_of(baseline_method()).name);
        return result;
    }
    for (const ErrorMetric metric : {ErrorMetric::RelMse, ErrorMetric::Noise})
        if (has_error(*base, metric) && has_error(run, metric)) {
            result.text = sentence(repeats_of(runs, *base, metric), repeats_of(runs, run, metric), run, metric);
            return result;
        }
    result.text = fmt::format("{}: too few samples to compare yet", name_of(run.label));
    return result;
}

/// The headline while no method with a field has been measured.
std::string nothing_learned_text(RunList runs, std::uint64_t picture) {
    if (std::ranges::none_of(runs, [&](const auto& run) { return run->label.picture == picture; }))
        return "Nothing measured yet: the plot begins after a few passes";
    return fmt::format("Only {} so far: {} render with a learned field", info_of(baseline_method()).name,
                       method_keys(&MethodInfo::uses_field));
}

}  // namespace

std::vector<Headline> make_headlines(RunList runs, std::uint64_t picture) {
    std::vector<const LiveRun*> newest;
    for (const auto& run : runs) {
        if (run->label.picture != picture || run->label.method == baseline_method()) continue;
        const auto is_older = [&](const LiveRun* other) { return same_kind(other->label, run->label); };
        // A run that has just begun says less than an older one.
        if (run->points.empty() && std::ranges::any_of(newest, is_older)) continue;
        std::erase_if(newest, is_older);
        newest.push_back(run.get());
    }
    std::vector<Headline> headlines;
    for (const LiveRun* run : newest) headlines.push_back(headline_of(runs, *run));
    if (headlines.empty()) headlines.push_back({0, 0xff969ca6u, nothing_learned_text(runs, picture)});
    return headlines;
}

}  // namespace pl
