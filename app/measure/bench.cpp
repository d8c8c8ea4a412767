// `pathlight bench`: accuracy against time, for methods x back ends x scenes x seeds.
#include <algorithm>
#include <ctime>
#include <map>
#include <random>
#include <set>

#include <fmt/format.h>

#include "app/commands.h"
#include "app/json_file.h"
#include "app/make_backend.h"
#include "app/measure/gate.h"
#include "app/measure/make_reference.h"
#include "app/open_scene.h"
#include "app/picture_file.h"
#include "app/progress.h"

namespace pl {
namespace {

/// Of the shuffled order of runs: recorded, so that a bench can be repeated in the same order.
constexpr std::uint64_t kOrderSeed = 1;

struct BenchScene {
    std::string name;  ///< of its file
    LoadedScene loaded;
    Options options;
    std::shared_ptr<const Reference> reference;
};

struct PlannedRun {
    std::size_t scene = 0;
    MethodId method = MethodId::Default;
    std::string backend;
    std::uint64_t seed = 1;
    bool warm_up = false;
};

/// The shell command that repeats a bench in any folder.
std::string command_of(const CommandLine& line) {
    std::string text = "pathlight bench";
    for (const std::string& input : line.options.inputs) text += " " + shell_word(input);
    for (const GivenOption& given : line.given)
        if (given.spec->name != "output" && given.spec->name != "gate")
            text += fmt::format(" --{}{}{}", given.spec->name, given.text.empty() ? "" : " ",
                                given.text.empty() ? "" : shell_word(given.text));
    return text + " -o DIR";
}

std::string utc_date() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&now, &parts);
    char text[32];
    return {text, std::strftime(text, sizeof(text), "%Y-%m-%d %H:%M UTC", &parts)};
}

class Bench {
public:
    Bench(const CommandLine& line, Console& console) : line_(line), console_(console), folder_(line.options.output) {
        open_scenes();
        methods_ = line.options.methods;
        if (methods_.empty())
            for (const MethodInfo& info : all_methods()) methods_.push_back(info.id);
        names_ = line.options.backends.empty() ? available_backends() : line.options.backends;
        for (const std::string& name : names_) backends_[name] = make_backend(name, line.options.threads);
        if (!line.options.reference_folder.empty()) find_references();
        if (!line.options.gate.empty()) earlier_ = read_results(line.options.gate);
    }

    int run() {
        const Json plan = plan_json();
        folder_.adopt_plan(plan);
        const bool complete = make_references() && make_runs();
        BenchResults results{.plan = plan,
                             .command = command_of(line_),
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
    void open_scenes() {
        std::set<std::string> names;
        for (const std::string& input : line_.options.inputs) {
            CommandLine line = line_;
            line.options.scene = input;
            BenchScene scene{.name = {},
                             .loaded = open_scene(input, line_.options.knobs, console_),
                             .options = {},
                             .reference = {}};
            scene.options = resolve_options(line, *scene.loaded.scene);
            scene.name = scene.loaded.scene->source.stem().string();
            if (!names.insert(scene.name).second)
                throw Error(ErrorKind::Usage,
                            fmt::format("'bench' tells scenes apart by name: expected each once, got '{}' twice",
                                        scene.name));
            scenes_.push_back(std::move(scene));
        }
    }

    /// What decides the numbers of a bench; runs of another plan are not its own.
    Json plan_json() const {
        Json scenes = Json::array();
        for (const BenchScene& scene : scenes_) {
            Json settings = Json::object();
            for (const OptionSpec& spec : option_table())
                if (spec.print != nullptr && spec.commands.has(Command::Bench) && spec.name != "seed")
                    settings[std::string(spec.name)] = spec.print(scene.options);
            scenes.push_back({{"name", scene.name},
                              {"scene", scene.options.scene},
                              {"picture_hash", content_of(*scene.loaded.scene, scene.options.render).picture_hash},
                              {"settings", settings}});
        }
        Json methods = Json::array();
        for (const MethodId method : methods_) methods.push_back(info_of(method).name);
        Json devices = Json::object();
        for (const auto& [name, backend] : backends_)
            devices[name] = {{"device", backend->info().device}, {"threads", backend->info().threads}};
        return {{"schema", kPlanSchema},        {"version", PL_VERSION},   {"scenes", scenes},
                {"methods", methods},           {"backends", devices},     {"first_seed", line_.options.render.seed},
                {"seeds", line_.options.seeds}, {"order_seed", kOrderSeed}};
    }

    /// From the folder that was given; nothing is made there.
    void find_references() {
        const ReferenceStore store(line_.options.reference_folder);
        for (BenchScene& scene : scenes_)
            scene.reference = std::make_shared<const Reference>(
                store.require(content_of(*scene.loaded.scene, scene.options.render)));
    }

    /// In the bench's own folder. False if interrupted.
    bool make_references() {
        const ReferenceStore store(folder_.references());
        for (BenchScene& scene : scenes_) {
            if (scene.reference) continue;
            Options options = scene.options;
            options.spp = options.reference_spp;
            options.time_limit_seconds.reset();
            options.render.method = MethodId::Default;
            options.render.next_event = true;
            Session session(backends_.at(names_.front()), scene.loaded.scene, options.render);
            ReferenceOutcome outcome = make_reference(session, options, store, interrupt_, console_);
            if (outcome.interrupted) return false;
            scene.reference = std::make_shared<const Reference>(std::move(outcome.reference));
        }
        return true;
    }

    Json references_json() const {
        Json references = Json::object();
        for (const BenchScene& scene : scenes_) {
            if (!scene.reference) continue;
            const auto& [first, second] = scene.reference->halves;
            references[scene.name] = {{"spp", Json::array({first.spp, second.spp})},
                                      {"noise_relmse", scene.reference->noise().relmse}};
        }
        return references;
    }

    /// For the report, which shows it beside the others.
    void save_reference_pictures() const {
        for (const BenchScene& scene : scenes_) {
            const auto& [first, second] = scene.reference->halves;
            folder_.save_reference_picture(scene.name, {.width = first.image.width,
                                                        .height = first.image.height,
                                                        .pixels = weighted_mean(first.image.pixels, first.spp,
                                                                                second.image.pixels, second.spp)});
        }
    }

    BenchCell cell_of(const PlannedRun& run) const {
        return {scenes_[run.scene].name, std::string(info_of(run.method).name), run.backend};
    }

    /// What is still to do: blocks of one seed each, shuffled within, so that slow changes of the machine fall on all
    /// cells alike; before them a warm-up of every cell that has anything left.
    std::vector<PlannedRun> remaining_runs() const {
        std::vector<PlannedRun> blocks;
        std::vector<PlannedRun> warm_ups;
        std::set<BenchCell> warmed;
        for (int block = 0; block < line_.options.seeds; ++block) {
            for (const PlannedRun& run : shuffled_block(block)) {
                if (folder_.load_run(cell_of(run), run.seed)) continue;
                blocks.push_back(run);
                if (!warmed.insert(cell_of(run)).second) continue;
                warm_ups.push_back(run);
                warm_ups.back().warm_up = true;
            }
        }
        warm_ups.insert(warm_ups.end(), blocks.begin(), blocks.end());
        return warm_ups;
    }

    std::vector<PlannedRun> shuffled_block(int block) const {
        std::vector<PlannedRun> runs;
        for (std::size_t scene = 0; scene < scenes_.size(); ++scene)
            for (const MethodId method : methods_)
                for (const std::string& backend : names_)
                    runs.push_back({scene, method, backend,
                                    line_.options.render.seed + static_cast<std::uint64_t>(block), false});
        std::mt19937_64 generator(kOrderSeed + static_cast<std::uint64_t>(block));
        for (std::size_t i = runs.size(); i > 1; --i) std::swap(runs[i - 1], runs[generator() % i]);
        return runs;
    }

    /// False if interrupted; what was finished is on disk then.
    bool make_runs() {
        save_reference_pictures();
        const std::vector<PlannedRun> runs = remaining_runs();
        ProgressDisplay progress(console_, !line_.options.no_progress && !line_.options.quiet);
        for (std::size_t i = 0; i < runs.size(); ++i) {
            const auto show = [&](const Session& session) {
                const double share = share_done(session, scenes_[runs[i].scene].options);
                progress.show({.activity = "bench",
                               .share = (static_cast<double>(i) + share) / static_cast<double>(runs.size()),
                               .spp = session.passes(),
                               .detail = fmt::format("run {} of {}: {}, seed {}{}", i + 1, runs.size(),
                                                     cell_of(runs[i]).title(), runs[i].seed,
                                                     runs[i].warm_up ? " (warm-up)" : "")});
            };
            if (interrupt_.raised() || !make_run(runs[i], show)) return false;
        }
        return true;
    }

    static double share_done(const Session& session, const Options& options) {
        double share = static_cast<double>(session.passes()) / options.spp_limit();
        if (options.time_limit_seconds)
            share = std::max(share, charged_seconds(session.clocks()) / *options.time_limit_seconds);
        return std::min(share, 1.0);
    }

    bool make_run(const PlannedRun& planned, const std::function<void(const Session&)>& show) {
        const BenchScene& scene = scenes_[planned.scene];
        RenderSettings settings = scene.options.render;
        settings.method = planned.method;
        settings.seed = planned.seed;
        const std::shared_ptr<RenderBackend>& backend = backends_.at(planned.backend);
        Session session(backend, scene.loaded.scene, settings, scene.loaded.load_seconds);
        BenchRun run{.cell = cell_of(planned),
                     .seed = planned.seed,
                     .warm_up = planned.warm_up,
                     .device = backend->info().device,
                     .threads = backend->info().threads,
                     .series = {}};
        RunObserver observer{.on_point = {}, .on_work = show};
        if (!planned.warm_up && planned.seed == line_.options.render.seed)
            observer.on_point = [&](const RunPoint& point, const Snapshot& snapshot) {
                folder_.save_picture(run.cell, point,
                                     {.width = snapshot.width, .height = snapshot.height, .pixels = snapshot.pixels});
            };
        auto series = record_run(session,
                                 {.spp = scene.options.spp_limit(),
                                  .seconds = scene.options.time_limit_seconds,
                                  .target_error = scene.options.target_error},
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
    std::vector<BenchScene> scenes_;
    std::vector<MethodId> methods_;
    std::vector<std::string> names_;  ///< of back ends
    std::map<std::string, std::shared_ptr<RenderBackend>> backends_;
    std::optional<BenchResults> earlier_;
};

}  // namespace

int run_bench(const CommandLine& line, Console& console) { return Bench(line, console).run(); }

}  // namespace pl
