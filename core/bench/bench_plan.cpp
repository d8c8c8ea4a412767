#include "core/bench/bench_plan.h"

#include <algorithm>
#include <random>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/io/json_file.h"

namespace pl::bench {
namespace {

namespace fs = std::filesystem;

std::string seed_name(std::uint64_t seed) { return fmt::format("seed-{}", seed); }

}  // namespace

void BenchFolder::adopt_plan(const Json& plan) const {
    make_folder(path_ / "runs");
    make_folder(path_ / "pictures");
    const fs::path file = path_ / "plan.json";
    if (fs::exists(file)) {
        const Json earlier = read_json_file(file, kPlanSchema);
        for (const Json& difference : Json::diff(earlier, plan)) {
            const std::string where = difference.at("path");
            if (where == "/seeds") continue;
            const Json::json_pointer pointer(where);
            const auto value = [&](const Json& json) {
                return json.contains(pointer) ? json.at(pointer).dump() : "none";
            };
            throw Error(ErrorKind::Usage,
                        fmt::format("{}: holds a bench of another plan: expected {} {}, got {}; take another "
                                    "folder, or delete this one",
                                    path_.string(), where, value(earlier), value(plan)));
        }
    }
    write_json_file(file, plan);
}

fs::path BenchFolder::run_path(const BenchCell& cell, const std::string& which) const {
    return path_ / "runs" / fmt::format("{}-{}.json", cell.file_name(), which);
}

std::optional<BenchRun> BenchFolder::load_run(const BenchCell& cell, std::uint64_t seed) const {
    const fs::path path = run_path(cell, seed_name(seed));
    if (!fs::exists(path)) return std::nullopt;
    return read_members(path, [&] { return run_from_json(read_json_file(path, kRunSchema)); });
}

void BenchFolder::save_run(const BenchRun& run) const {
    write_json_file(run_path(run.cell, run.warm_up ? "warm-up" : seed_name(run.seed)), run_json(run));
}

std::vector<BenchRun> BenchFolder::all_runs() const {
    std::vector<BenchRun> runs;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(path_ / "runs", ignored))
        if (entry.path().extension() == ".json")
            runs.push_back(
                read_members(entry.path(), [&] { return run_from_json(read_json_file(entry.path(), kRunSchema)); }));
    std::sort(runs.begin(), runs.end(), [](const BenchRun& a, const BenchRun& b) {
        return std::tie(a.cell, a.warm_up, a.seed) < std::tie(b.cell, b.warm_up, b.seed);
    });
    return runs;
}

fs::path BenchFolder::picture_path(const BenchCell& cell, std::uint32_t spp) const {
    return path_ / "pictures" / fmt::format("{}-{}.exr", cell.file_name(), spp);
}

void BenchFolder::save_picture(const BenchCell& cell, const RunPoint& point, const LinearImage& picture) const {
    write_exr(picture_path(cell, point.spp), picture,
              {{"scene", cell.scene},
               {"method", cell.method},
               {"backend", cell.backend},
               {"spp", std::to_string(point.spp)},
               {"seconds", fmt::format("{}", charged_seconds(point.clocks))}},
              ExrNumbers::Half);
}

fs::path BenchFolder::reference_picture_path(const std::string& scene) const {
    return path_ / "pictures" / fmt::format("{}-reference.exr", scene);
}

void BenchFolder::save_reference_picture(const std::string& scene, const LinearImage& picture) const {
    write_exr(reference_picture_path(scene), picture, {{"scene", scene}}, ExrNumbers::Half);
}

namespace {

/// Recorded, so that a bench can be repeated in the same order.
constexpr std::uint64_t kOrderSeed = 1;

Json scene_json(const BenchScene& scene) {
    return {{"name", scene.name},
            {"scene", scene.source},
            {"picture_hash", scene.content.picture_hash},
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
