#include "core/bench/bench.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "core/bench/reference_store.h"
#include "core/measure/flip.h"

namespace pl::bench {
namespace {

/// Share of a run that is over, by whichever limit is nearer.
double share_done(const Session& session, FilmSlot slot, const RunLimits& limits) {
    double share = static_cast<double>(session.passes(slot)) / limits.spp;
    if (limits.seconds) share = std::max(share, charged_seconds(session.clocks(slot)) / *limits.seconds);
    return std::min(share, 1.0);
}

/// Seconds of a run, by its limit of time and, where a reference tells the speed of `default`, by its limit of
/// samples: samples of methods that learn take longer. Empty if neither is known.
std::optional<double> expected_seconds(const BenchScene& scene) {
    std::optional<double> seconds = scene.limits.seconds;
    if (scene.limits.target_error || !scene.reference) return seconds;
    const auto& [first, second] = scene.reference->halves;
    const double of_samples = scene.limits.spp * (first.seconds + second.seconds) / (first.spp + second.spp);
    return std::min(seconds.value_or(of_samples), of_samples);
}

}  // namespace

Bench::Bench(BenchSettings settings, BenchObserver observer)
    : settings_(std::move(settings)), observer_(std::move(observer)), folder_(settings_.folder) {
    if (!settings_.reference_folder.empty()) find_references();
}

BenchResults Bench::run() {
    const Json plan = settings_.plan.json();
    folder_.adopt_plan(plan);
    take_references();
    if (observer_.tell) observer_.tell(forecast());
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

/// "references: 2 of 2 x 4096 samples per pixel; runs: 54, warm-ups included, one after the other about 1:48 min".
std::string Bench::forecast() const {
    const auto& scenes = settings_.plan.scenes;
    const auto missing = std::ranges::count_if(scenes, [](const BenchScene& scene) { return !scene.reference; });
    const std::vector<PlannedRun> runs = remaining_runs();
    double seconds = 0.0;  // NaN: not known
    for (const PlannedRun& run : runs) seconds += expected_seconds(scenes[run.scene]).value_or(NAN);
    std::string text;
    if (missing > 0)
        text = fmt::format("references: {} of 2 x {} samples per pixel; ", missing, settings_.reference_spp);
    text += fmt::format("runs: {}, warm-ups included", runs.size());
    return text + (std::isfinite(seconds) ? ", one after the other about " + duration_text(seconds)
                                          : ", whose time is not known before");
}

/// Takes the complete references of the bench's own folder.
void Bench::take_references() {
    const ReferenceStore store(folder_.references());
    for (BenchScene& scene : settings_.plan.scenes) {
        if (scene.reference) continue;
        std::optional<Reference> found = store.find(scene.content);
        if (found && std::min(found->halves[0].spp, found->halves[1].spp) >= settings_.reference_spp)
            scene.reference = std::make_shared<const Reference>(*std::move(found));
    }
}

/// In the folder that was given; no reference is made there.
void Bench::find_references() {
    const ReferenceStore store(settings_.reference_folder);
    for (BenchScene& scene : settings_.plan.scenes)
        scene.reference = std::make_shared<const Reference>(store.require(scene.content));
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
        if (observer_.tell) observer_.tell(forecast());
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
    for (const BenchScene& scene : settings_.plan.scenes)
        folder_.save_reference_picture(scene.name, scene.reference->mean());
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
    const bool keeps_pictures = !planned.warm_up && planned.seed == plan.first_seed;
    std::vector<Vec3f> last;
    const RunObserver observer{.on_point =
                                   [&](const RunPoint&, const Snapshot& snapshot) {
                                       last = snapshot.pixels;
                                       if (keeps_pictures)
                                           finished.pictures.push_back({.width = snapshot.width,
                                                                        .height = snapshot.height,
                                                                        .pixels = snapshot.pixels});
                                   },
                               .on_work = on_work};
    auto series = record_run(session, slot_of(settings), scene.limits, scene.reference->pixels(), stop, observer);
    if (!series) return std::nullopt;
    finished.run.series = *std::move(series);
    finished.run.flip = pl::mean_of(flip_map(last, scene.reference->mean().pixels, settings.width));
    return finished;
}

}  // namespace pl::bench
