// The cost of a segment of a guided path, compared with one of default path tracing.
// Usage: segment_bench [SCENE [VOLUMES [ROUNDS [THREADS [TRACER]]]]]; the scene "ball" has a million triangles, the tracer is
// auto, dense, bvh or embree. Processor time, of one thread unless told otherwise. The methods take turns, one pass each,
// so that other work on the machine meets all of them; a checksum tells whether two builds make the same pictures.
#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/io/load_scene.h"
#include "core/session/session.h"
#include "cpu/cpu_backend.h"
#include "tests/bench/machine_load.h"
#include "tests/bench/quartiles.h"
#include "tests/support/files/temporary_folder.h"
#include "tests/support/scenes/bumpy_ball.h"

namespace pl::bench {
namespace {

constexpr int kSide = 512;      ///< of the picture
constexpr int kWarmUp = 4;      ///< passes before the first that counts
constexpr int kPrecompute = 4;  ///< paths per cell: the learned values hardly matter to the time

/// One method under way, and the time of its passes.
class Run {
public:
    Run(std::shared_ptr<const SceneDescription> scene, MethodId method, int volumes, const CpuSettings& cpu)
        : session_(make_cpu_backend(cpu), scene, settings_of(*scene, method, volumes)) {}

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
    static RenderSettings settings_of(const SceneDescription& scene, MethodId method, int volumes) {
        RenderSettings settings;
        settings.method = method;
        settings.width = settings.height = kSide;
        settings.camera = scene.camera;
        settings.field.volumes = volumes;
        settings.field.precompute_samples = kPrecompute;
        return settings;
    }

    Session session_;
    Snapshot last_;
};

SceneDescription open_scene(const std::string& name) {
    constexpr std::size_t kRows = 501;  // of the ball
    const std::filesystem::path assets = PL_SOURCE_DIR "/assets";
    if (name != "ball") return load_scene(name, assets);
    const test::TemporaryFolder folder;
    return load_scene(test::write_bumpy_ball(folder.path(), kRows).string(), assets);
}

IntersectorChoice tracer_of(const std::string& name) {
    if (name == "auto") return IntersectorChoice::Auto;
    if (name == "dense") return IntersectorChoice::Dense;
    if (name == "bvh") return IntersectorChoice::Bvh;
    if (name == "embree") return IntersectorChoice::Embree;
    throw Error(ErrorKind::Usage, "tracer: expected auto, dense, bvh or embree, got " + name);
}

void measure(const std::string& name, int volumes, int rounds, const CpuSettings& cpu) {
    const auto scene = std::make_shared<const SceneDescription>(open_scene(name));
    std::vector<std::unique_ptr<Run>> runs;
    for (const MethodInfo& method : all_methods())
        runs.push_back(std::make_unique<Run>(scene, method.id, volumes, cpu));
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
        std::printf("%-14s %8.1f %8.1f %8.2f [%.2f, %.2f] %8.1f   %08x\n", std::string(all_methods()[i].name).c_str(),
                    quartiles_of(runs[i]->render_ns).median,
                    *std::min_element(runs[i]->render_ns.begin(), runs[i]->render_ns.end()), quartiles.median,
                    quartiles.lower, quartiles.upper, quartiles_of(runs[i]->learn_ns).median, runs[i]->checksum());
    }
}

}  // namespace
}  // namespace pl::bench

int main(int count, char** arguments) try {
    const std::string scene = count > 1 ? arguments[1] : "cornell";
    const int volumes = count > 2 ? std::atoi(arguments[2]) : 0;
    const int rounds = count > 3 ? std::max(1, std::atoi(arguments[3])) : 15;
    const int threads = count > 4 ? std::max(1, std::atoi(arguments[4])) : 1;
    const std::string tracer = count > 5 ? arguments[5] : "auto";
    const pl::CpuSettings cpu{.threads = threads, .intersector = pl::bench::tracer_of(tracer)};
    const pl::bench::MachineLoad load;
    std::printf(
        "%s, %d volumes (0: the default), %d threads, tracer %s: ns per segment, as a multiple of the first row, "
        "and for learning\n",
        scene.c_str(), volumes, threads, tracer.c_str());
    std::printf("%-14s %8s %8s %8s %13s %8s   picture\n", "method", "median", "least", "ratio", "[quartiles]",
                "learning");
    pl::bench::measure(scene, volumes, rounds, cpu);
    const pl::bench::MachineLoad::Shares shares = load.shares();
    std::printf("processors busy: %.2f with this, %.2f with other work, %.2f stolen\n", shares.own, shares.foreign,
                shares.stolen);
    return 0;
} catch (const pl::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
