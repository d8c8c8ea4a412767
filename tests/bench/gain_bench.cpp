// The gain of guiding over default path tracing: mean squared error at equal samples and at equal time,
// which is processor time, because other work on the machine comes and goes.
// Usage: gain_bench SCENE... [KEY=NUMBER]...; keys and their defaults are in Setup. The error is measured against two
// independent halves of a reference, (x-r1)(x-r2), whose noise drops out of the mean. With uniform=1 a last column has the gain
// over directions uniform over the hemisphere.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/io/load_scene.h"
#include "core/measure/metrics.h"
#include "core/session/session.h"
#include "cpu/cpu_backend.h"
#include "tests/bench/machine_load.h"
#include "tests/bench/quartiles.h"
#include "tests/bench/uniform_sampling.h"

namespace pl::bench {
namespace {

/// Settings of the command line.
struct Setup {
    std::map<std::string, double> numbers{
        {"spp", 128},        {"seeds", 5},      {"side", 128},
        {"reference", 4096}, {"threads", 2},    {"volumes", 0},
        {"bins", 256},       {"fraction", 0},   {"floor", kUniformShare},
        {"rate", 4},         {"precompute", 0}, {"nee", 0},
        {"megabytes", 16.0}, {"target", 0},     {"light", 0},
        {"roulette", 0},     {"uniform", 0},    {"refine", kRefineByRecords},
    };
    std::vector<std::string> scenes;

    double operator[](const std::string& key) const { return numbers.at(key); }
    int integer(const std::string& key) const { return static_cast<int>(numbers.at(key)); }
};

Setup parse(int argc, char** argv) {
    Setup setup;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const std::size_t equals = word.find('=');
        if (equals == std::string::npos) {
            setup.scenes.push_back(word);
            continue;
        }
        const auto number = setup.numbers.find(word.substr(0, equals));
        if (number == setup.numbers.end())
            throw Error(ErrorKind::Usage, "gain_bench: unknown key '" + word.substr(0, equals) + "'");
        number->second = std::strtod(word.c_str() + equals + 1, nullptr);
    }
    if (setup.scenes.empty()) setup.scenes = {"cornell", "door"};
    return setup;
}

RenderSettings settings_of(const Setup& setup, const SceneDescription& scene) {
    RenderSettings settings;
    settings.width = settings.height = setup.integer("side");
    settings.camera = scene.camera;
    settings.next_event = setup["nee"] != 0.0;
    if (setup["fraction"] > 0.0)
        settings.mixture = {.learned = 0, .bsdf_fraction = static_cast<float>(setup["fraction"])};
    settings.field.volumes = setup.integer("volumes");
    settings.field.bins = setup.integer("bins");
    settings.field.budget_megabytes = setup["megabytes"];
    settings.field.uniform_floor = static_cast<float>(setup["floor"]);
    settings.field.refine_share = static_cast<float>(setup["refine"]);
    settings.field.rate = static_cast<LearningRate>(setup.integer("rate"));
    settings.field.learning = {.target = static_cast<LearningTarget>(setup.integer("target")),
                               .light = static_cast<LearnedLight>(setup.integer("light"))};
    settings.roulette = static_cast<RouletteRule>(setup.integer("roulette"));
    if (setup["precompute"] > 0.0) settings.field.precompute_samples = setup.integer("precompute");
    return settings;
}

struct Picture {
    std::vector<Vec3f> pixels;
    double seconds = 0.0;  ///< of all processors, for placing, precomputing, learning and rendering
    double dark_share = 0.0;
};

Picture render(std::shared_ptr<const SceneDescription> scene, const RenderSettings& settings, std::uint32_t passes,
               int threads) {
    const std::clock_t start = std::clock();
    Session session(make_cpu_backend({.threads = threads}), std::move(scene), settings);
    const FilmSlot slot = slot_of(session.settings());
    while (session.passes(slot) < passes) session.advance(slot);
    const Snapshot snapshot = session.snapshot(slot);
    return {snapshot.pixels, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC,
            static_cast<double>(snapshot.counters.zero_contribution_paths) /
                static_cast<double>(snapshot.counters.paths)};
}

/// Results of one method over all seeds.
struct Series {
    std::vector<double> error;
    std::vector<double> trimmed;
    std::vector<double> seconds;
    double dark_share = 0.0;
};

void measure(const Setup& setup, const std::string& name) {
    const auto scene = std::make_shared<const SceneDescription>(load_scene(name, PL_SOURCE_DIR "/assets"));
    const int threads = setup.integer("threads");
    RenderSettings settings = settings_of(setup, *scene);
    RenderSettings exact = settings;
    exact.next_event = true;
    const auto reference_passes = static_cast<std::uint32_t>(setup["reference"]);
    exact.seed = 1001;
    const Picture r1 = render(scene, exact, reference_passes, threads);
    exact.seed = 1002;
    const Picture r2 = render(scene, exact, reference_passes, threads);

    const auto add = [&](Series& series, const Picture& x) {
        const Metrics metrics = measure_error(x.pixels, {r1.pixels, r2.pixels});
        series.error.push_back(metrics.mse);
        series.trimmed.push_back(metrics.mse_trimmed);
        series.seconds.push_back(x.seconds);
        series.dark_share = x.dark_share;
    };
    const auto passes = static_cast<std::uint32_t>(setup["spp"]);
    std::map<MethodId, Series> results;
    Series uniform;
    for (int seed = 1; seed <= setup.integer("seeds"); ++seed) {
        settings.seed = static_cast<std::uint64_t>(seed);
        for (const MethodInfo& method : all_methods()) {
            settings.method = method.id;
            add(results[method.id], render(scene, settings, passes, threads));
        }
        if (setup["uniform"] != 0.0) add(uniform, {render_uniform(*scene, settings, passes, threads)});
    }
    const Series& plain = results.at(MethodId::Default);
    for (const MethodInfo& method : all_methods()) {
        const Series& series = results.at(method.id);
        const double error = quartiles_of(series.error).median;
        const double gain = quartiles_of(plain.error).median / error;
        const double trimmed_gain = quartiles_of(plain.trimmed).median / quartiles_of(series.trimmed).median;
        const double slowdown = quartiles_of(series.seconds).median / quartiles_of(plain.seconds).median;
        std::printf("%-12s %-14s %10.3g %8.2f %8.2f %8.2f %8.2f %7.3f", name.c_str(),
                    std::string(method.name).c_str(), error, gain, trimmed_gain, slowdown, gain / slowdown,
                    series.dark_share);
        if (!uniform.error.empty()) std::printf(" %8.2f", quartiles_of(uniform.error).median / error);
        std::printf("\n");
    }
    std::fflush(stdout);
}

}  // namespace
}  // namespace pl::bench

int main(int argc, char** argv) {
    try {
        const pl::bench::Setup setup = pl::bench::parse(argc, argv);
        for (const auto& [key, number] : setup.numbers) std::printf("%s=%g ", key.c_str(), number);
        std::printf("\n");
        const pl::bench::MachineLoad load;
        std::printf("%-12s %-14s %10s %8s %8s %8s %8s %7s\n", "scene", "method", "MSE", "gain", "-0.1 %", "time",
                    "gain/t", "dark");
        if (setup["uniform"] != 0.0) std::printf("%94s\n", "over uniform");
        for (const std::string& scene : setup.scenes) pl::bench::measure(setup, scene);
        const pl::bench::MachineLoad::Shares shares = load.shares();
        std::printf("processors busy: %.2f own, %.2f others, %.2f stolen\n", shares.own, shares.foreign,
                    shares.stolen);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
