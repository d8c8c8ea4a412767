#include "core/bench/bench_plan.h"

#include <random>
#include <utility>

#include "core/bench/bench_folder.h"

namespace pl::bench {
namespace {

/// Recorded, so that a bench can be repeated in the same order.
constexpr std::uint64_t kOrderSeed = 1;

Json scene_json(const BenchScene& scene) {
    return {{"name", scene.name},
            {"scene", scene.source},
            {"picture_hash", content_of(*scene.description, scene.settings).picture_hash},
            {"settings", scene.options}};
}

}  // namespace

RenderSettings BenchMethod::settings(RenderSettings of_scene) const {
    of_scene.method = method;
    if (representation) of_scene.field.representation = *representation;
    return of_scene;
}

std::vector<PlannedRun> BenchPlan::shuffled_block(int block) const {
    const auto number = static_cast<std::uint64_t>(block);
    std::vector<PlannedRun> runs;
    for (std::size_t scene = 0; scene < scenes.size(); ++scene)
        for (std::size_t method = 0; method < methods.size(); ++method)
            for (const std::string& backend : backend_names)
                runs.push_back({scene, method, backend, first_seed + number, false});
    std::mt19937_64 generator(kOrderSeed + number);
    for (std::size_t i = runs.size(); i > 1; --i) std::swap(runs[i - 1], runs[generator() % i]);
    return runs;
}

BenchCell BenchPlan::cell_of(const PlannedRun& run) const {
    return {scenes[run.scene].name, methods[run.method].name, run.backend};
}

Json BenchPlan::json() const {
    Json scene_list = Json::array();
    for (const BenchScene& scene : scenes) scene_list.push_back(scene_json(scene));
    Json method_list = Json::array();
    for (const BenchMethod& method : methods) method_list.push_back(method.name);
    Json devices = Json::object();
    for (const std::string& name : backend_names) {
        const BackendInfo info = backends.at(name)->info();
        devices[name] = {{"device", info.device}, {"threads", info.threads}};
    }
    return {{"schema", kPlanSchema}, {"version", PL_VERSION},    {"scenes", scene_list}, {"methods", method_list},
            {"backends", devices},   {"first_seed", first_seed}, {"seeds", seeds},       {"order_seed", kOrderSeed}};
}

}  // namespace pl::bench
