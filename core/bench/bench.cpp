#include "core/bench/bench.h"

#include <algorithm>
#include <ctime>
#include <set>

#include <fmt/format.h>

#include "core/bench/reference_store.h"

namespace pl::bench {
namespace {

std::string utc_date() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&now, &parts);
    char text[32];
    return {text, std::strftime(text, sizeof(text), "%Y-%m-%d %H:%M UTC", &parts)};
}

/// Share of a run that is over, by whichever limit is nearer.
double share_done(const Session& session, FilmSlot slot, const RunLimits& limits) {
    double share = static_cast<double>(session.passes(slot)) / limits.spp;
    if (limits.seconds) share = std::max(share, charged_seconds(session.clocks(slot)) / *limits.seconds);
    return std::min(share, 1.0);
}

}  // namespace

Bench::Bench(BenchSettings settings, BenchObserver observer)
    : settings_(std::move(settings)), observer_(std::move(observer)), folder_(settings_.folder) {
    if (!settings_.reference_folder.empty()) find_references();
}

BenchResults Bench::run() {
    const Json plan = settings_.plan.json();
    folder_.adopt_plan(plan);
    const bool complete = make_references() && make_runs();
    BenchResults results{.plan = plan,
                         .command = settings_.command,
                         .date = utc_date(),
                         .references = references_json(),
                         .runs = folder_.all_runs(),
                         .summary = {},
                         .complete = complete};
    results.summary = summarize(results.runs, method_order(plan));
    write_results(folder_, results);
    return results;
}

/// In the folder that was given; no reference is made there.
void Bench::find_references() {
    const ReferenceStore store(settings_.reference_folder);
    for (BenchScene& scene : settings_.plan.scenes)
        scene.reference =
            std::make_shared<const Reference>(store.require(content_of(*scene.description, scene.settings)));
}

/// In the bench's own folder. False if stopped.
bool Bench::make_references() {
    BenchPlan& plan = settings_.plan;
    const ReferenceStore store(folder_.references());
    for (BenchScene& scene : plan.scenes) {
        if (scene.reference) continue;
        RenderSettings settings = scene.settings;
        settings.method = MethodId::Default;
        settings.next_event = true;
        Session session(plan.backends.at(plan.backend_names.front()), scene.description, settings);
        ReferenceOutcome outcome = make_reference(session,
                                                  {.scene = scene.source,
                                                   .spp = settings_.reference_spp,
                                                   .seconds = {},
                                                   .stop = observer_.stop,
                                                   .show = observer_.show},
                                                  store);
        if (outcome.interrupted) return false;
        scene.reference = std::make_shared<const Reference>(std::move(outcome.reference));
    }
    return true;
}

Json Bench::references_json() const {
    Json references = Json::object();
    for (const BenchScene& scene : settings_.plan.scenes) {
        if (!scene.reference) continue;
        const auto& [first, second] = scene.reference->halves;
        references[scene.name] = {{"spp", Json::array({first.spp, second.spp})},
                                  {"noise_relmse", scene.reference->noise().relmse}};
    }
    return references;
}

/// For the report, which shows it beside the pictures of the runs.
void Bench::save_reference_pictures() const {
    for (const BenchScene& scene : settings_.plan.scenes) {
        const auto& [first, second] = scene.reference->halves;
        folder_.save_reference_picture(
            scene.name, {.width = first.image.width,
                         .height = first.image.height,
                         .pixels = weighted_mean(first.image.pixels, first.spp, second.image.pixels, second.spp)});
    }
}

/// The runs missing in the folder, block by block, after a warm-up of each of their cells.
std::vector<PlannedRun> Bench::remaining_runs() const {
    const BenchPlan& plan = settings_.plan;
    std::vector<PlannedRun> blocks;
    std::vector<PlannedRun> warm_ups;
    std::set<BenchCell> warmed;
    for (int block = 0; block < plan.seeds; ++block) {
        for (const PlannedRun& run : plan.shuffled_block(block)) {
            if (folder_.load_run(plan.cell_of(run), run.seed)) continue;
            blocks.push_back(run);
            if (!warmed.insert(plan.cell_of(run)).second) continue;
            warm_ups.push_back(run);
            warm_ups.back().warm_up = true;
        }
    }
    warm_ups.insert(warm_ups.end(), blocks.begin(), blocks.end());
    return warm_ups;
}

/// False if stopped; finished runs are on disk then.
bool Bench::make_runs() {
    save_reference_pictures();
    const std::vector<PlannedRun> runs = remaining_runs();
    if (!observer_.deal) return make_runs_here(runs);
    std::size_t finished = 0;
    return observer_.deal(settings_.plan, runs, [&](FinishedRun run) {
        const std::string title = run.run.cell.title();
        const std::uint64_t seed = run.run.seed;
        keep(std::move(run));
        ++finished;
        if (observer_.show)
            observer_.show({.activity = "bench",
                            .share = static_cast<double>(finished) / static_cast<double>(runs.size()),
                            .spp = 0,
                            .detail = fmt::format("{} of {} runs, the last one {}, seed {}", finished, runs.size(),
                                                  title, seed)});
    });
}

bool Bench::make_runs_here(const std::vector<PlannedRun>& runs) {
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const auto show = [&](const Session& session, FilmSlot slot) {
            if (!observer_.show) return;
            const double share = share_done(session, slot, settings_.plan.scenes[runs[i].scene].limits);
            observer_.show({.activity = "bench",
                            .share = (static_cast<double>(i) + share) / static_cast<double>(runs.size()),
                            .spp = session.passes(slot),
                            .detail = fmt::format("run {} of {}: {}, seed {}{}", i + 1, runs.size(),
                                                  settings_.plan.cell_of(runs[i]).title(), runs[i].seed,
                                                  runs[i].warm_up ? " (warm-up)" : "")});
        };
        if (is_stopped()) return false;
        std::optional<FinishedRun> finished = make_run(settings_.plan, runs[i], observer_.stop, show);
        if (!finished) return false;
        keep(*std::move(finished));
    }
    return true;
}

/// Pictures are kept of the first seed.
void Bench::keep(FinishedRun finished) const {
    BenchRun& run = finished.run;
    run.commit = settings_.commit;
    for (std::size_t i = 0; i < finished.pictures.size(); ++i)
        folder_.save_picture(run.cell, run.series.points[i], finished.pictures[i]);
    folder_.save_run(run);
    if (observer_.on_run) observer_.on_run(run);
}

std::optional<FinishedRun> make_run(const BenchPlan& plan, const PlannedRun& planned, const StopFlag* stop,
                                    const std::function<void(const Session&, FilmSlot)>& on_work) {
    const BenchScene& scene = plan.scenes[planned.scene];
    const std::shared_ptr<RenderBackend>& backend = plan.backends.at(planned.backend);
    const BackendInfo info = backend->info();
    FinishedRun finished{.run = {.cell = plan.cell_of(planned),
                                 .seed = planned.seed,
                                 .warm_up = planned.warm_up,
                                 .device = info.device,
                                 .threads = info.threads,
                                 .series = {}}};
    RenderSettings settings = plan.methods[planned.method].settings(scene.settings);
    settings.seed = planned.seed;
    Session session(backend, scene.description, settings, scene.load_seconds);
    RunObserver observer{.on_point = {}, .on_work = on_work};
    if (!planned.warm_up && planned.seed == plan.first_seed)
        observer.on_point = [&](const RunPoint&, const Snapshot& snapshot) {
            finished.pictures.push_back(
                {.width = snapshot.width, .height = snapshot.height, .pixels = snapshot.pixels});
        };
    auto series = record_run(session, slot_of(settings), scene.limits, scene.reference->pixels(), stop, observer);
    if (!series) return std::nullopt;
    finished.run.series = *std::move(series);
    return finished;
}

}  // namespace pl::bench
