// The gain of guiding over default path tracing, with and without light samples, at equal samples and at equal time.
// Usage: gain_bench [SCENE...] [KEY=VALUE]...; keys and their defaults are in GainSetup. The scene "all" stands for all of
// assets/scenes and the larger ones of the folder `larger`. nee=0 measures without light samples, 1 with them, 2 both.
//
// One run of a method and seed has results at every length: it goes on until it has `spp` samples per pixel and `seconds` of
// processor time (because other work on the machine comes and goes), and is measured along the way, off the clock. The error
// is taken against two independent halves of a reference, (x-r1)(x-r2), whose noise drops out of the mean. References are
// kept in the folder `references`, by content of the picture: delete them after a change that corrects pictures.
//
// Gain at equal samples: error of `default` over the error of the method. Equal-time factor at a length: the same when both have
// taken the time t that `default` needs for that length. Between checkpoints errors lie on straight lines in log-log; where a
// run has ended before t, on a line of slope -1 from its last point. Means and 95 % intervals are over seeds, of logarithms
// of ratios of runs with the same seed.
#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>

#include "core/bench/reference_store.h"
#include "core/io/load_scene.h"
#include "core/scene/scene_hash.h"
#include "cpu/cpu_backend.h"
#include "tests/bench/gain_report.h"

namespace pl::benchmarks {
namespace {

/// Scenes where light samples find little of the light: guided references need far fewer samples.
constexpr std::array kGuidedReferences{"door",    "indirect",  "labyrinth", "pillars",
                                       "shelter", "staircase", "thin-wall"};

/// With light samples and with defaults for the keys of learning, so that runs with other keys have the same reference.
bench::Reference reference_of(const GainSetup& setup, const std::string& name,
                              const std::shared_ptr<const SceneDescription>& scene) {
    RenderSettings settings;
    if (std::find(kGuidedReferences.begin(), kGuidedReferences.end(), name) != kGuidedReferences.end())
        settings.method = MethodId::Reinforcement;
    settings.width = setup.width();
    settings.height = setup.height();
    settings.camera = scene->camera;
    settings.next_event = true;
    const bench::ReferenceStore store(setup.words.at("references"));
    const auto spp = static_cast<std::uint32_t>(setup["reference"]);
    if (auto found = store.find(bench::content_of(scene_hash(*scene), settings));
        found && found->halves[0].spp >= spp && found->halves[1].spp >= spp)
        return *std::move(found);
    Session session(make_cpu_backend({.threads = setup.integer("threads")}), scene, settings);
    return bench::make_reference(session, {.scene = name, .spp = spp, .seconds = {}}, store).reference;
}

GainResult measure(const GainSetup& setup, const RunSetting& setting) {
    GainResult result{.scene = setting.scene->source.stem().string(),
                      .light_samples = setting.settings.next_event,
                      .length = setting.length};
    for (int i = 1; i <= setup.integer("seeds"); ++i) {
        const auto seed = static_cast<std::uint64_t>(i);
        for (const MethodId method : setup.methods())
            result.runs[std::string(info_of(method).name)].push_back(measure_run(setting, method, seed));
        if (setup["uniform"] != 0.0) result.runs["uniform"].push_back(measure_uniform(setting, seed));
    }
    return result;
}

void run(const GainSetup& setup) {
    const MachineLoad load;
    const std::string& file = setup.words.at("json");
    Json results = Json::array();
    print_gain_header();
    for (const std::string& name : setup.scenes) {
        const auto scene = std::make_shared<const SceneDescription>(load_scene(name, PL_SOURCE_DIR "/assets"));
        const bench::Reference reference = reference_of(setup, name, scene);
        RunSetting setting{.scene = scene,
                           .settings = settings_of(setup, *scene),
                           .reference = reference.pixels(),
                           .length = setup.run_length(),
                           .threads = setup.integer("threads")};
        for (const bool light_samples : setup.light_samples()) {
            setting.settings.next_event = light_samples;
            const GainResult result = measure(setup, setting);
            print_gains(result);
            results.push_back(gains_json(result));
            if (!file.empty()) write_json_file(file, gain_file(setup, load.shares(), results));
        }
    }
    const MachineLoad::Shares shares = load.shares();
    std::printf("processors busy: %.2f own, %.2f others, %.2f stolen\n", shares.own, shares.foreign, shares.stolen);
}

}  // namespace
}  // namespace pl::benchmarks

int main(int argc, char** argv) {
    try {
        const pl::benchmarks::GainSetup setup = pl::benchmarks::parse_gain_setup(argc, argv);
        for (const auto& [key, number] : setup.numbers) std::printf("%s=%g ", key.c_str(), number);
        std::printf("\n");
        pl::benchmarks::run(setup);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
