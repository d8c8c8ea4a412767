#include "app/measure/bench_plan.h"

#include <random>
#include <set>

#include <fmt/format.h>

#include "app/make_backend.h"
#include "app/measure/bench_folder.h"
#include "core/base/error.h"

namespace pl {
namespace {

/// Recorded, so that a bench can be repeated in the same order.
constexpr std::uint64_t kOrderSeed = 1;

std::vector<BenchScene> open_scenes(const CommandLine& given, Console& console) {
    std::vector<BenchScene> scenes;
    std::set<std::string> names;
    for (const std::string& input : given.options.inputs) {
        CommandLine line = given;
        line.options.scene = input;
        BenchScene scene{
            .name = {}, .loaded = open_scene(input, given.options.knobs, console), .options = {}, .reference = {}};
        scene.options = resolve_options(line, *scene.loaded.scene);
        scene.name = scene.loaded.scene->source.stem().string();
        if (!names.insert(scene.name).second)
            throw Error(
                ErrorKind::Usage,
                fmt::format("'bench' tells scenes apart by name: expected each once, got '{}' twice", scene.name));
        scenes.push_back(std::move(scene));
    }
    return scenes;
}

Json scene_json(const BenchScene& scene) {
    Json settings = Json::object();
    for (const OptionSpec& spec : option_table())
        if (spec.print != nullptr && spec.commands.has(Command::Bench) && spec.name != "seed")
            settings[std::string(spec.name)] = spec.print(scene.options);
    return {{"name", scene.name},
            {"scene", scene.options.scene},
            {"picture_hash", content_of(*scene.loaded.scene, scene.options.render).picture_hash},
            {"settings", settings}};
}

}  // namespace

std::vector<PlannedRun> BenchPlan::shuffled_block(int block) const {
    const auto number = static_cast<std::uint64_t>(block);
    std::vector<PlannedRun> runs;
    for (std::size_t scene = 0; scene < scenes.size(); ++scene)
        for (const MethodId method : methods)
            for (const std::string& backend : backend_names)
                runs.push_back({scene, method, backend, first_seed + number, false});
    std::mt19937_64 generator(kOrderSeed + number);
    for (std::size_t i = runs.size(); i > 1; --i) std::swap(runs[i - 1], runs[generator() % i]);
    return runs;
}

BenchCell BenchPlan::cell_of(const PlannedRun& run) const {
    return {scenes[run.scene].name, std::string(info_of(run.method).name), run.backend};
}

Json BenchPlan::json() const {
    Json scene_list = Json::array();
    for (const BenchScene& scene : scenes) scene_list.push_back(scene_json(scene));
    Json method_list = Json::array();
    for (const MethodId method : methods) method_list.push_back(info_of(method).name);
    Json devices = Json::object();
    for (const std::string& name : backend_names) {
        const BackendInfo info = backends.at(name)->info();
        devices[name] = {{"device", info.device}, {"threads", info.threads}};
    }
    return {{"schema", kPlanSchema}, {"version", PL_VERSION},    {"scenes", scene_list}, {"methods", method_list},
            {"backends", devices},   {"first_seed", first_seed}, {"seeds", seeds},       {"order_seed", kOrderSeed}};
}

BenchPlan make_bench_plan(const CommandLine& line, Console& console) {
    BenchPlan plan{.scenes = open_scenes(line, console),
                   .methods = line.options.methods,
                   .backend_names = line.options.backends,
                   .backends = {},
                   .first_seed = line.options.render.seed,
                   .seeds = line.options.seeds};
    if (plan.methods.empty())
        for (const MethodInfo& info : all_methods()) plan.methods.push_back(info.id);
    if (plan.backend_names.empty()) plan.backend_names = available_backends();
    for (const std::string& name : plan.backend_names) plan.backends[name] = make_backend(name, line.options.threads);
    return plan;
}

std::string repeating_command(const CommandLine& line) {
    std::string text = "pathlight bench";
    for (const std::string& input : line.options.inputs) text += fmt::format(" {}", shell_word(input));
    for (const GivenOption& given : line.given) {
        if (given.spec->name == "output" || given.spec->name == "gate") continue;
        text += fmt::format(" --{}", given.spec->name);
        if (!given.spec->value.empty()) text += fmt::format(" {}", shell_word(given.text));
    }
    return text + " -o DIR";
}

}  // namespace pl
