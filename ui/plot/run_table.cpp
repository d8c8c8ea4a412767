#include "ui/plot/run_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "ui/draw/value_text.h"

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

/// Whether a run has too few samples to be compared.
bool has_just_begun(const LiveRun& run) { return run.points.empty() || run.points.back().spp < kFewestSamples; }

/// Of two runs of one kind the newer one counts, unless it has just begun, or had when it was ended.
bool replaces(const LiveRun& newer, const LiveRun& older) {
    return !newer.points.empty() && (!has_just_begun(newer) || has_just_begun(older));
}

}  // namespace

bool are_repetitions(const RunLabel& a, const RunLabel& b) { return are_of_one_kind(a, b) && a.warm == b.warm; }

Repetitions repetitions_of(RunList runs, const LiveRun& like) {
    constexpr double kLeastShare = 0.5;
    Repetitions repetitions;
    double longest = 0.0;
    for (const auto& run : runs) {
        if (!are_repetitions(run->label, like.label) || run->points.empty()) continue;
        const auto same = std::ranges::find_if(
            repetitions, [&](const auto& other) { return other->label.seed == run->label.seed; });
        if (same != repetitions.end() && !replaces(*run, **same)) continue;
        if (same != repetitions.end()) repetitions.erase(same);
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

namespace {

using Run = std::shared_ptr<const LiveRun>;

/// The run of each kind that stands for it, in the order of the kinds' first runs.
std::vector<Run> newest_of_kinds(RunList runs, std::uint64_t picture) {
    std::vector<Run> newest;
    for (const Run& run : runs) {
        if (run->label.picture != picture) continue;
        const auto same =
            std::ranges::find_if(newest, [&](const Run& other) { return are_repetitions(other->label, run->label); });
        if (same == newest.end())
            newest.push_back(run);
        else if (replaces(*run, **same))
            *same = run;
    }
    return newest;
}

/// Drops the kinds that were used least recently.
void keep_newest(std::vector<Run>& kinds, std::size_t most) {
    while (kinds.size() > most) kinds.erase(std::ranges::min_element(kinds, {}, &LiveRun::number));
}

/// "1 renders default".
std::string way_to(MethodId method) {
    return fmt::format("{} renders {}", info_of(method).key, info_of(method).name);
}

std::string missing_base_text(const RunLabel& label) {
    return fmt::format("{} has nothing to be compared with yet: {}", name_of(label), way_to(baseline_method()));
}

/// A run that is not rendered gets no more samples by waiting.
std::string too_few_text(const LiveRun& shorter) {
    if (shorter.in_progress) return name_of(shorter.label) + ": too few samples to compare yet";
    return fmt::format("{} has too few samples to compare, and has to go on: {}", name_of(shorter.label),
                       way_to(shorter.label.method));
}

MissingGain reason_without_gain(bool is_base, bool has_base) {
    if (is_base) return MissingGain::IsBase;
    return has_base ? MissingGain::TooFewSamples : MissingGain::NoBase;
}

/// Whether a has fewer samples than b.
bool is_shorter(const LiveRun& a, const LiveRun& b) {
    return a.points.empty() || (!b.points.empty() && a.points.back().spp < b.points.back().spp);
}

/// `shorter`: of the two runs that are compared.
std::string remark_of(const RunRow& row, const LiveRun& shorter) {
    switch (row.missing) {
    case MissingGain::IsBase: return name_of(row.label) + ": other runs are compared with it";
    case MissingGain::TooFewSamples: return too_few_text(shorter);
    case MissingGain::NoBase: return missing_base_text(row.label);
    case MissingGain::None: break;
    }
    return row.gain->sentence;
}

RunRow row_of(RunList runs, const LiveRun& run, const RunBase& wanted) {
    RunRow row{.run = run.number,
               .label = run.label,
               .is_base = is_base(run.label, wanted),
               .seeds = std::max<std::size_t>(repetitions_of(runs, run).size(), 1),
               .gain = std::nullopt,
               .remark = ""};
    if (!run.points.empty()) {
        row.samples = cost_of(run.points.back(), CostAxis::Samples);
        row.seconds_per_sample = cost_of(run.points.back(), CostAxis::Seconds) / std::max(row.samples, 1.0);
    }
    const auto base = base_of(runs, run, wanted);
    if (base && !row.is_base) row.gain = gain_of_run(runs, *base, run);
    if (!row.gain) row.missing = reason_without_gain(row.is_base, base != nullptr);
    row.base = base ? base->number : 0;
    row.remark = remark_of(row, base && is_shorter(*base, run) ? *base : run);
    return row;
}

/// The next step while no method with a field was measured. Nothing if one is being rendered: its row is about to come.
std::string note_of(RunList runs, const std::vector<RunRow>& rows, bool in_turns) {
    if (rows.empty()) return "Nothing measured yet: the plot begins with the second pass";
    const bool renders_base = std::ranges::any_of(rows, [&](const RunRow& row) {
        const auto run = find_run(runs, row.run);
        return row.is_base && run && run->in_progress;
    });
    if (!std::ranges::all_of(rows, &RunRow::is_base)) return "";
    if (in_turns) return "The other run is measured from its second pass on";
    if (!renders_base) return "";
    return fmt::format("Only {} so far: {} render with a learned field", info_of(baseline_method()).name,
                       method_keys(&MethodInfo::uses_field));
}

}  // namespace

RunTable make_run_table(RunList runs, std::uint64_t picture, const RunBase& base, bool in_turns) {
    std::vector<Run> kinds = newest_of_kinds(runs, picture);
    keep_newest(kinds, RunTable::kMostRows);
    RunTable table{.base = base, .rows = {}, .older = {}, .note = {}};
    for (const Run& run : kinds) table.rows.push_back(row_of(runs, *run, base));
    for (const Run& run : runs) {
        const bool is_row = std::ranges::any_of(kinds, [&](const Run& kind) { return kind->number == run->number; });
        if (run->label.picture == picture && !is_row) table.older.push_back(run->number);
    }
    table.note = note_of(runs, table.rows, in_turns);
    return table;
}

namespace {

/// The newest row of such a run that has a gain with an interval; null without one.
template <class IsSuch>
const RunRow* measured_row(const RunTable& table, IsSuch&& is_such) {
    const RunRow* newest = nullptr;
    for (const RunRow& row : table.rows)
        if (is_such(row.label) && row.gain && row.gain->source != IntervalSource::None &&
            (newest == nullptr || row.run > newest->run))
            newest = &row;
    return newest;
}

std::string reason_text(const MethodInfo& method, Verdict verdict) {
    if (verdict != Verdict::Faster) return "learning does not pay here";
    return method.learns ? "its paths have learned where the light comes from"
                         : "its paths know where the light comes from";
}

}  // namespace

const RunRow* learning_row(const RunTable& table, bool next_event) {
    const RunRow* const row = measured_row(table, [&](const RunLabel& label) {
        return label.method == learning_method() && label.next_event == next_event;
    });
    return row != nullptr && !row->label.warm ? row : nullptr;
}

std::string ahead_text(const RunRow& row) {
    const Interval& net = row.gain->net;
    switch (verdict_of(net)) {
    case Verdict::Faster: return ratio_text(net.value) + " times ahead";
    case Verdict::Slower: return ratio_text(1.0 / net.value) + " times behind";
    case Verdict::NoDifference:
    case Verdict::Undecided:
    case Verdict::Unresolved: break;
    }
    return "neither ahead nor behind";
}

TurnsHeadline turns_headline(const RunTable& table, const std::array<RunLabel, 2>& halves,
                             std::optional<std::size_t> late) {
    if (late)
        return {
            fmt::format("The {} half catches up, until both have had the same time.", *late == 0 ? "left" : "right"),
            "", nullptr};
    const RunLabel& base = halves[base_side(halves)];
    const bool is_left = base_side(halves) == 1;
    const RunLabel& label = halves[is_left ? 0 : 1];
    const char* const own = is_left ? "left" : "right";
    const char* const other = is_left ? "right" : "left";
    const RunRow* const row =
        measured_row(table, [&](const RunLabel& other_label) { return are_of_one_kind(other_label, label); });
    if (row == nullptr || !is_base(base, table.base))
        return {fmt::format("Both halves get the same time. Has the {} one less noise?", own), "", nullptr};
    const Interval& net = row->gain->net;
    const Verdict verdict = verdict_of(net);
    const std::string detail =
        fmt::format("Measured{}: for the same noise the {} half would need {} times as long ({} to {}).",
                    row->label.warm ? ", without the time of earlier learning" : "", other, ratio_text(net.value),
                    ratio_text(net.low), ratio_text(net.high));
    if (verdict != Verdict::Faster && verdict != Verdict::Slower)
        return {"Same time, and no difference in noise between the halves that is beyond chance.", detail, row};
    const bool differ_in_method = base.method == baseline_method() && base.next_event == label.next_event;
    return {fmt::format("Same time, and the {} half is {}{}.", own, ahead_text(*row),
                        differ_in_method ? ": " + reason_text(info_of(label.method), verdict) : ""),
            detail, row};
}

std::string gain_text(const RunRow& row) {
    switch (row.missing) {
    case MissingGain::IsBase: return "baseline";
    case MissingGain::TooFewSamples: return "too short";
    case MissingGain::NoBase: return "no baseline";
    case MissingGain::None: break;
    }
    const Interval& net = row.gain->net;
    if (!std::isfinite(net.value)) return verdict_text(net);
    if (row.gain->source == IntervalSource::None) return ratio_text(net.value) + "x, no interval";
    const Verdict verdict = verdict_of(net);
    return verdict == Verdict::Faster || verdict == Verdict::Slower ? ratio_text(net.value) + "x" : verdict_text(net);
}

std::string interval_text(const RunRow& row) {
    if (!row.gain || row.gain->source == IntervalSource::None || !std::isfinite(row.gain->net.value)) return "";
    return fmt::format("{}-{}", ratio_text(row.gain->net.low), ratio_text(row.gain->net.high));
}

}  // namespace pl::ui
