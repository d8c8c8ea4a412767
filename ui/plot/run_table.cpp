#include "ui/plot/run_table.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ui/draw/method_keys.h"

namespace pl::ui {
namespace {

using Run = std::shared_ptr<const LiveRun>;

/// The run that stands for all repetitions of `like`: the newest, unless it has just begun.
bool is_better(const Run& candidate, const Run& now) { return !candidate->points.empty() || now->points.empty(); }

/// The newest run of each kind, in the order of the kinds' first runs.
std::vector<Run> newest_of_kinds(RunList runs, std::uint64_t picture) {
    std::vector<Run> newest;
    for (const Run& run : runs) {
        if (run->label.picture != picture) continue;
        const auto same =
            std::ranges::find_if(newest, [&](const Run& other) { return are_repetitions(other->label, run->label); });
        if (same == newest.end())
            newest.push_back(run);
        else if (is_better(run, *same))
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

MissingGain reason_without_gain(const LiveRun& run, bool has_base) {
    if (run.label.method == baseline_method()) return MissingGain::IsBase;
    return has_base ? MissingGain::TooFewSamples : MissingGain::NoBase;
}

/// Whether a has fewer samples than b.
bool is_shorter(const LiveRun& a, const LiveRun& b) {
    return a.points.empty() || (!b.points.empty() && a.points.back().spp < b.points.back().spp);
}

/// `shorter`: of the two runs that are compared.
std::string remark_of(const RunRow& row, const LiveRun& shorter) {
    switch (row.missing) {
    case MissingGain::IsBase: return name_of(row.label) + ": other methods are compared with it";
    case MissingGain::TooFewSamples: return too_few_text(shorter);
    case MissingGain::NoBase: return missing_base_text(row.label);
    case MissingGain::None: break;
    }
    return row.gain->sentence;
}

RunRow row_of(RunList runs, const LiveRun& run) {
    RunRow row{.run = run.number,
               .label = run.label,
               .seeds = std::max<std::size_t>(repetitions_of(runs, run).size(), 1),
               .gain = std::nullopt,
               .remark = ""};
    if (!run.points.empty()) {
        row.samples = cost_of(run.points.back(), CostAxis::Samples);
        row.seconds_per_sample = cost_of(run.points.back(), CostAxis::Seconds) / std::max(row.samples, 1.0);
    }
    const auto base = base_of(runs, run);
    if (base && run.label.method != baseline_method()) row.gain = gain_of_run(runs, *base, run);
    if (!row.gain) row.missing = reason_without_gain(run, base != nullptr);
    row.remark = remark_of(row, base && is_shorter(*base, run) ? *base : run);
    return row;
}

/// The next step while no method with a field was measured. Nothing if one is being rendered: its row is about to come.
std::string note_of(RunList runs, const std::vector<RunRow>& rows) {
    if (rows.empty()) return "Nothing measured yet: the plot begins with the second pass";
    const auto is_base = [](const RunRow& row) { return row.label.method == baseline_method(); };
    const bool renders_base = std::ranges::any_of(rows, [&](const RunRow& row) {
        const auto run = find_run(runs, row.run);
        return is_base(row) && run && run->in_progress;
    });
    if (!renders_base || !std::ranges::all_of(rows, is_base)) return "";
    return fmt::format("Only {} so far: {} render with a learned field", info_of(baseline_method()).name,
                       method_keys(&MethodInfo::uses_field));
}

}  // namespace

RunTable make_run_table(RunList runs, std::uint64_t picture) {
    std::vector<Run> kinds = newest_of_kinds(runs, picture);
    keep_newest(kinds, RunTable::kMostRows);
    RunTable table;
    for (const Run& run : kinds) table.rows.push_back(row_of(runs, *run));
    for (const Run& run : runs) {
        const bool is_row = std::ranges::any_of(kinds, [&](const Run& kind) { return kind->number == run->number; });
        if (run->label.picture == picture && !is_row) table.older.push_back(run->number);
    }
    table.note = note_of(runs, table.rows);
    return table;
}

std::string gain_text(const RunRow& row) {
    switch (row.missing) {
    case MissingGain::IsBase: return "baseline";
    case MissingGain::TooFewSamples: return "too few samples";
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
