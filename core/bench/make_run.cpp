#include "core/bench/make_run.h"

namespace pl::bench {

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
