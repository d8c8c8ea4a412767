// The cost of a segment of a guided path, compared with one of default path tracing.
// Usage: segment_bench [SCENE [VOLUMES [ROUNDS [THREADS [LIGHT [METHOD]]]]]]; scenes as in bench_scenes.h, LIGHT is off, on
// or both: without and with light samples. Processor time, of one thread unless told otherwise. The methods take turns, one pass each, so that other work on the machine meets all of them; a
// ratio is to `default` with the same light samples. A checksum tells whether two builds make the same pictures.
#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/session/session.h"
#include "cpu/cpu_backend.h"
#include "tests/bench/bench_scenes.h"
#include "tests/bench/machine_load.h"
#include "tests/bench/quartiles.h"

namespace pl::benchmarks {
namespace {

constexpr int kSide = 512;      ///< of the picture
constexpr int kWarmUp = 4;      ///< passes before the first that counts
constexpr int kPrecompute = 4;  ///< paths per cell: the learned values hardly matter to the time

/// What the methods have in common.
struct Common {
    std::shared_ptr<const SceneDescription> scene;
    int volumes = 0;
    CpuSettings cpu;
    bool light_samples = false;
};

/// One method under way, and the time of its passes.
class Run {
public:
    Run(const Common& common, MethodId method)
        : session_(make_cpu_backend(common.cpu), common.scene, settings_of(common, method)) {}

    void render_pass() {
        std::clock_t start = std::clock();
        while (session_.advance(slot_of(session_.settings())) != Progress::Rendered) start = std::clock();
        const double ns = 1e9 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        const Snapshot now = session_.summary(slot_of(session_.settings()));
        const auto segments = static_cast<double>(now.counters.path.segments - last_.counters.path.segments);
        const double render = now.clocks.render - last_.clocks.render;
        const double learn = now.clocks.learn - last_.clocks.learn;
        render_ns.push_back(ns / segments * render / (render + learn));
        learn_ns.push_back(ns / segments * learn / (render + learn));
        last_ = now;
    }
    void forget_times() {
        render_ns.clear();
        learn_ns.clear();
    }
    std::uint32_t checksum() const {
        std::uint32_t sum = 0;
        for (const Vec3f& pixel : session_.snapshot(slot_of(session_.settings())).pixels)
            for (int i = 0; i < 3; ++i) sum = 31u * sum + std::bit_cast<std::uint32_t>(pixel[i]);
        return sum;
    }

    std::vector<double> render_ns;  ///< per segment. [pass]
    std::vector<double> learn_ns;   ///< per segment, between passes. [pass]

private:
    static RenderSettings settings_of(const Common& common, MethodId method) {
        RenderSettings settings;
        settings.method = method;
        settings.width = settings.height = kSide;
        settings.camera = common.scene->camera;
        settings.next_event = common.light_samples;
        settings.guiding = GuidingRule::Always;
        settings.field.volumes = common.volumes;
        settings.field.precompute_samples = kPrecompute;
        return settings;
    }

    Session session_;
    Snapshot last_;
};

/// Without and with light samples.
std::vector<bool> light_samples_of(const std::string& name) {
    if (name == "both") return {false, true};
    if (name == "off") return {false};
    if (name == "on") return {true};
    throw Error(ErrorKind::Usage, "light samples: expected off, on or both, got " + name);
}

/// All methods, or the one with this name.
std::vector<MethodInfo> methods_of(const std::string& name) {
    std::vector<MethodInfo> methods;
    for (const MethodInfo& method : all_methods())
        if (name == "all" || name == method.name) methods.push_back(method);
    if (methods.empty()) throw Error(ErrorKind::Usage, "method: expected all or a method, got " + name);
    return methods;
}

void measure(const Common& common, const std::vector<MethodInfo>& methods, int rounds) {
    std::vector<std::unique_ptr<Run>> runs;
    for (const MethodInfo& method : methods) runs.push_back(std::make_unique<Run>(common, method.id));
    for (const auto& run : runs) {
        for (int pass = 0; pass < kWarmUp; ++pass) run->render_pass();
        run->forget_times();
    }
    for (int round = 0; round < rounds; ++round)
        for (const auto& run : runs) run->render_pass();
    const std::vector<double>& plain = runs.front()->render_ns;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        std::vector<double> ratio;
        for (std::size_t round = 0; round < plain.size(); ++round)
            ratio.push_back(runs[i]->render_ns[round] / plain[round]);
        const Quartiles quartiles = quartiles_of(ratio);
        std::printf("%-14s %-5s %8.1f %8.1f %8.2f [%.2f, %.2f] %8.1f   %08x\n", std::string(methods[i].name).c_str(),
                    common.light_samples ? "on" : "off", quartiles_of(runs[i]->render_ns).median,
                    *std::min_element(runs[i]->render_ns.begin(), runs[i]->render_ns.end()), quartiles.median,
                    quartiles.lower, quartiles.upper, quartiles_of(runs[i]->learn_ns).median, runs[i]->checksum());
    }
}

}  // namespace
}  // namespace pl::benchmarks

int main(int count, char** arguments) try {
    const auto word = [&](int index, const char* otherwise) {
        return std::string(count > index ? arguments[index] : otherwise);
    };
    const std::string scene = word(1, "cornell");
    const int volumes = count > 2 ? std::atoi(arguments[2]) : 0;
    const int rounds = count > 3 ? std::max(1, std::atoi(arguments[3])) : 15;
    const int threads = count > 4 ? std::max(1, std::atoi(arguments[4])) : 1;
    const std::vector<bool> light_samples = pl::benchmarks::light_samples_of(word(5, "both"));
    const std::vector<pl::MethodInfo> methods = pl::benchmarks::methods_of(word(6, "all"));
    const pl::CpuSettings cpu{.threads = threads};
    const pl::benchmarks::MachineLoad load;
    std::printf("%s, %d volumes (0: the default), %d threads: ns per segment, as a multiple of `default` with "
                "the same light samples, and for learning\n",
                scene.c_str(), volumes, threads);
    std::printf("%-14s %-5s %8s %8s %8s %13s %8s   picture\n", "method", "light", "median", "least", "ratio",
                "[quartiles]", "learning");
    const auto description = std::make_shared<const pl::SceneDescription>(pl::benchmarks::open_bench_scene(scene));
    for (const bool light : light_samples)
        pl::benchmarks::measure({.scene = description, .volumes = volumes, .cpu = cpu, .light_samples = light},
                                methods, rounds);
    const pl::benchmarks::MachineLoad::Shares shares = load.shares();
    std::printf("processors busy: %.2f with this, %.2f with other work, %.2f stolen\n", shares.own, shares.foreign,
                shares.stolen);
    return 0;
} catch (const pl::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
