#include "app/measure/bench_options.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "app/make_backend.h"
#include "app/open_scene.h"
#include "app/option_parsers.h"
#include "core/base/error.h"
#include "core/fields/field_kernels.h"
#include "core/scene/scene_hash.h"

namespace pl {
namespace {

/// Every option of `bench` that decides its numbers, as text.
Json options_json(const Options& options) {
    Json json = Json::object();
    for (const OptionSpec& spec : option_table())
        if (spec.print != nullptr && spec.commands.has(Command::Bench) && spec.name != "seed")
            json[std::string(spec.name)] = spec.print(options);
    return json;
}

/// The name of a scene's file; of a file named "scene", as files of Mitsuba are, the name of its folder.
std::string scene_name(const std::filesystem::path& file) {
    const std::string stem = file.stem().string();
    const std::string folder = std::filesystem::absolute(file).parent_path().filename().string();
    return stem == "scene" && !folder.empty() ? folder : stem;
}

bench::BenchScene open_bench_scene(const CommandLine& given, const std::string& input, Console& console) {
    CommandLine line = given;
    line.options.scene = input;
    const LoadedScene loaded = open_scene(input, given.options.load, console);
    const Options options = resolve_options(line, *loaded.scene);
    return {.name = scene_name(loaded.scene->source),
            .source = options.scene,
            .description = loaded.scene,
            .load_seconds = loaded.load_seconds,
            .settings = options.render,
            .content = bench::content_of(scene_hash(*loaded.scene), options.render),
            .limits = {.spp = options.spp_limit(),
                       .seconds = options.time_limit_seconds,
                       .target_error = options.target_error,
                       .measure_share = 0.01 * options.measure_percent},
            .options = options_json(options),
            .reference = {}};
}

std::vector<bench::BenchScene> open_scenes(const CommandLine& line, Console& console) {
    std::vector<bench::BenchScene> scenes;
    std::set<std::string> names;
    for (const std::string& input : line.options.inputs) {
        scenes.push_back(open_bench_scene(line, input, console));
        const std::string& name = scenes.back().name;
        if (!names.insert(name).second)
            throw Error(ErrorKind::Usage,
                        fmt::format("'bench' tells scenes apart by name: expected each once, got '{}' twice", name));
    }
    return scenes;
}

/// Of several representations, each method that learns has one after the other.
std::vector<bench::BenchMethod> bench_methods(const Options& options) {
    std::vector<MethodId> ids = options.methods;
    if (ids.empty())
        for (const MethodInfo& info : all_methods()) ids.push_back(info.id);
    std::vector<bench::BenchMethod> methods;
    for (const MethodId id : ids) {
        const MethodInfo& info = info_of(id);
        if (!info.learns || options.fields.empty()) {
            methods.push_back({.name = std::string(info.name), .method = id});
            continue;
        }
        for (const Representation field : options.fields)
            methods.push_back({.name = options.fields.size() == 1 ? std::string(info.name)
                                                                  : fmt::format("{}-{}", info.name, name_of(field)),
                               .method = id,
                               .representation = field});
    }
    return methods;
}

}  // namespace

bench::BenchPlan make_bench_plan(const CommandLine& line, Console& console) {
    bench::BenchPlan plan{.scenes = open_scenes(line, console),
                          .methods = bench_methods(line.options),
                          .backend_names = line.options.backends,
                          .backends = {},
                          .first_seed = line.options.render.seed,
                          .seeds = line.options.seeds};
    const bool is_on_cpu = std::ranges::any_of(plan.scenes, [&](const bench::BenchScene& scene) {
        return std::ranges::any_of(plan.methods, [&](const bench::BenchMethod& method) {
            return !is_for_devices(method.settings(scene.settings).field.representation);
        });
    });
    if (plan.backend_names.empty())
        plan.backend_names = is_on_cpu ? std::vector<std::string>{"cpu"} : available_backends();
    for (const std::string& name : plan.backend_names)
        plan.backends[name] = make_own_backend(name, line.options.threads);
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
