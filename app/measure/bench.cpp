// `pathlight bench`: accuracy against time, for methods x back ends x scenes x seeds.
#include <algorithm>
#include <ctime>
#include <functional>
#include <set>

#include <fmt/format.h>

#include "app/build_info.h"
#include "app/commands.h"
#include "app/measure/bench_plan.h"
#include "app/measure/effect_costs.h"
#include "app/measure/gate.h"
#include "app/measure/make_reference.h"
#include "app/progress.h"

namespace pl {
namespace {

std::string utc_date() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&now, &parts);
    char text[32];
    return {text, std::strftime(text, sizeof(text), "%Y-%m-%d %H:%M UTC", &parts)};
}

class Bench {
public:
    Bench(const CommandLine& line, Console& console)
        : line_(line), console_(console), folder_(line.options.output), plan_(make_bench_plan(line, console)) {
        if (!line.options.reference_folder.empty()) find_references();
        if (!line.options.gate.empty()) earlier_ = read_results(line.options.gate);
    }

    int run() {
        const Json plan = plan_.json();
        folder_.adopt_plan(plan);
        const bool complete = make_references() && make_runs();
        BenchResults results{.plan = plan,
                             .command = repeating_command(line_),
                             .date = utc_date(),
                             .references = references_json(),
                             .runs = folder_.all_runs(),
                             .summary = {},
                             .complete = complete};
        results.summary = summarize(results.runs, method_order(plan));
        write_results(folder_, results);
        return report(results);
    }

private:
    /// From the folder that was given; nothing is made there.
    void find_references() {
        const ReferenceStore store(line_.options.reference_folder);
        for (BenchScene& scene : plan_.scenes)
            scene.reference = std::make_shared<const Reference>(
                store.require(content_of(*scene.loaded.scene, scene.options.render)));
    }

    /// In the bench's own folder. False if interrupted.
    bool make_references() {
        const ReferenceStore store(folder_.references());
        for (BenchScene& scene : plan_.scenes) {
            if (scene.reference) continue;
            Options options = scene.options;
            options.spp = options.reference_spp;
            options.time_limit_seconds.reset();
            options.render.method = MethodId::Default;
            options.render.next_event = true;
            Session session(plan_.backends.at(plan_.backend_names.front()), scene.loaded.scene, options.render);
            ReferenceOutcome outcome = make_reference(session, options, store, interrupt_, console_);
            if (outcome.interrupted) return false;
            scene.reference = std::make_shared<const Reference>(std::move(outcome.reference));
        }
        return true;
    }

    Json references_json() const {
        Json references = Json::object();
        for (const BenchScene& scene : plan_.scenes) {
            if (!scene.reference) continue;
            const auto& [first, second] = scene.reference->halves;
            references[scene.name] = {{"spp", Json::array({first.spp, second.spp})},
                                      {"noise_relmse", scene.reference->noise().relmse}};
        }
        return references;
    }

    /// For the report, which shows it beside the others.
    void save_reference_pictures() const {
        for (const BenchScene& scene : plan_.scenes) {
            const auto& [first, second] = scene.reference->halves;
            folder_.save_reference_picture(scene.name, {.width = first.image.width,
                                                        .height = first.image.height,
                                                        .pixels = weighted_mean(first.image.pixels, first.spp,
                                                                                second.image.pixels, second.spp)});
        }
    }

    /// What is still to do, block by block; before it a warm-up of every cell that has anything left.
    std::vector<PlannedRun> remaining_runs() const {
        std::vector<PlannedRun> blocks;
        std::vector<PlannedRun> warm_ups;
        std::set<BenchCell> warmed;
        for (int block = 0; block < plan_.seeds; ++block) {
            for (const PlannedRun& run : plan_.shuffled_block(block)) {
                if (folder_.load_run(plan_.cell_of(run), run.seed)) continue;
                blocks.push_back(run);
                if (!warmed.insert(plan_.cell_of(run)).second) continue;
                warm_ups.push_back(run);
                warm_ups.back().warm_up = true;
            }
        }
        warm_ups.insert(warm_ups.end(), blocks.begin(), blocks.end());
        return warm_ups;
    }

    /// False if interrupted; what was finished is on disk then.
    bool make_runs() {
        save_reference_pictures();
        const std::vector<PlannedRun> runs = remaining_runs();
        ProgressDisplay progress(console_, !line_.options.no_progress && !line_.options.quiet);
        for (std::size_t i = 0; i < runs.size(); ++i) {
            const auto show = [&](const Session& session, FilmSlot slot) {
                const double share = share_done(session, slot, plan_.scenes[runs[i].scene].options);
                progress.show({.activity = "bench",
                               .share = (static_cast<double>(i) + share) / static_cast<double>(runs.size()),
                               .spp = session.passes(slot),
                               .detail = fmt::format("run {} of {}: {}, seed {}{}", i + 1, runs.size(),
                                                     plan_.cell_of(runs[i]).title(), runs[i].seed,
                                                     runs[i].warm_up ? " (warm-up)" : "")});
            };
            if (interrupt_.raised() || !make_run(runs[i], show)) return false;
        }
        return true;
    }

    static double share_done(const Session& session, FilmSlot slot, const Options& options) {
        double share = static_cast<double>(session.passes(slot)) / options.spp_limit();
        if (options.time_limit_seconds)
            share = std::max(share, charged_seconds(session.clocks(slot)) / *options.time_limit_seconds);
        return std::min(share, 1.0);
    }

    bool make_run(const PlannedRun& planned, const std::function<void(const Session&, FilmSlot)>& show) {
        const BenchScene& scene = plan_.scenes[planned.scene];
        RenderSettings settings = scene.options.render;
        settings.method = planned.method;
        settings.seed = planned.seed;
        const std::shared_ptr<RenderBackend>& backend = plan_.backends.at(planned.backend);
        Session session(backend, scene.loaded.scene, settings, scene.loaded.load_seconds);
        BenchRun run{.cell = plan_.cell_of(planned),
                     .seed = planned.seed,
                     .warm_up = planned.warm_up,
                     .device = backend->info().device,
                     .threads = backend->info().threads,
                     .commit = std::string(commit_id()),
                     .series = {}};
        RunObserver observer{.on_point = {}, .on_work = show};
        if (!planned.warm_up && planned.seed == plan_.first_seed)
            observer.on_point = [&](const RunPoint& point, const Snapshot& snapshot) {
                folder_.save_picture(run.cell, point,
                                     {.width = snapshot.width, .height = snapshot.height, .pixels = snapshot.pixels});
            };
        auto series = record_run(session, slot_of(settings),
                                 {.spp = scene.options.spp_limit(),
                                  .seconds = scene.options.time_limit_seconds,
                                  .target_error = scene.options.target_error,
                                  .measure_share = 0.01 * scene.options.measure_percent},
                                 scene.reference->pixels(), interrupt_.flag(), observer);
        if (!series) return false;
        run.series = *std::move(series);
        folder_.save_run(run);
        console_.event("run", {{"scene", run.cell.scene},
                               {"method", run.cell.method},
                               {"backend", run.cell.backend},
                               {"seed", run.seed},
                               {"warm_up", run.warm_up},
                               {"spp", run.end().spp},
                               {"t_render", charged_seconds(run.end().clocks)},
                               {"error", run.end().metrics.relmse}});
        return true;
    }

    int report(const BenchResults& results) {
        console_.event(
            "done",
            {{"output", folder_.path().string()}, {"runs", results.runs.size()}, {"interrupted", !results.complete}});
        if (!results.complete) {
            console_.log().warning(fmt::format("interrupted: {} runs are kept, the same command goes on from there",
                                               results.runs.size()));
            return kExitInterrupted;
        }
        for (const CellSummary& cell : results.summary.cells)
            console_.result(fmt::format("{:<40} relMSE {}, {} s, {} runs\n", cell.cell.title(),
                                        interval_text(cell.final_error, cell.ends.size()),
                                        interval_text(cell.seconds, cell.ends.size()), cell.ends.size()));
        for (const Comparison& comparison : results.summary.comparisons)
            console_.result(
                fmt::format("{} {}\n", comparison.cell.title(), headline(comparison.gain, comparison.base_method)));
        console_.remark(
            fmt::format("{}: results.json, series.csv, summary.csv, summary.md\n", folder_.path().string()));
        if (line_.options.seeds < static_cast<int>(kGoodRuns))
            console_.log().notice(
                fmt::format("{} seeds: intervals from fewer than {} runs are rough", line_.options.seeds, kGoodRuns));
        if (earlier_)
            console_.result(require_gate(gate_rows(*earlier_, results, line_.options.tolerance_percent),
                                         line_.options.tolerance_percent));
        return 0;
    }

    const CommandLine& line_;
    Console& console_;
    InterruptGuard interrupt_;
    BenchFolder folder_;
    BenchPlan plan_;
    std::optional<BenchResults> earlier_;
};

}  // namespace

int run_bench(const CommandLine& line, Console& console) {
    const Options& options = line.options;
    if (options.effects)
        return measure_effect_costs(make_bench_plan(line, console), options.threads, options.output, console);
    return Bench(line, console).run();
}

}  // namespace pl
