// Large models: the time to open, build and trace them, next to Embree in the same run.
// Usage: scale_bench [THREADS [SCENE...]]. Without scenes: balls of ten thousand, a hundred thousand and a million
// triangles. Passes of all ways to trace alternate, and ratios are of neighbors, because other work on the machine
// comes and goes.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <vector>

#include "core/base/timer.h"
#include "core/io/load_scene.h"
#include "core/scene/build_bvh.h"
#include "core/scene/needed_effects.h"
#include "core/scene/pack_scene.h"
#include "core/session/session.h"
#include "cpu/cpu_backend.h"
#include "cpu/rays/batch_tracer.h"
#include "tests/bench/embree_loop.h"
#include "tests/bench/machine_load.h"
#include "tests/bench/quartiles.h"
#include "tests/support/files/temporary_folder.h"
#include "tests/support/scenes/bumpy_ball.h"

namespace pl::benchmarks {
namespace {

const std::filesystem::path kAssets = std::filesystem::path(PL_SOURCE_DIR) / "assets";
constexpr int kSide = 512;
constexpr int kRounds = 7;

/// Wall-clock seconds from opening a file to its first picture.
double seconds_to_first_picture(const std::string& name, int threads) {
    const Stopwatch watch;
    const auto scene = std::make_shared<const SceneDescription>(load_scene(name, kAssets));
    Session session(make_cpu_backend({.threads = threads}), scene,
                    {.width = 1280, .height = 720, .camera = scene->camera});
    while (session.advance(slot_of(session.settings())) != Progress::Rendered) continue;
    return watch.seconds();
}

/// A tracer and its measured rates.
struct Tracer {
    const char* name;
    std::unique_ptr<RenderBackend> backend;  ///< none: the plain loop
    std::vector<double> rays_per_second{};
};

/// Millions of path segments per second of every tracer; the last one is the loop over Embree's single rays.
class Race {
public:
    Race(const SceneDescription& description, std::shared_ptr<const HostScene> scene, EmbreeLoop& loop, int threads)
        : camera_(make_camera(description.camera, kSide, kSide)), scene_(std::move(scene)), loop_(loop) {
        tracers_.push_back({"back end, wide hierarchy", make_cpu_backend({.threads = threads})});
        tracers_.push_back({"loop over Embree's single rays", nullptr});
        for (const Tracer& tracer : tracers_) {
            if (!tracer.backend) continue;
            tracer.backend->upload_scene(scene_);
            tracer.backend->reset_film({}, kSide, kSide);
        }
    }

    void run() {
        for (std::uint32_t round = 0; round <= kRounds; ++round)
            for (Tracer& tracer : tracers_) {
                const Stopwatch watch;
                const PassCounters counters = pass(tracer, round);
                const double rate = static_cast<double>(counters.path.segments) / watch.seconds();
                if (round > 0) tracer.rays_per_second.push_back(rate);  // the first one warms up
            }
    }

    void print() const {
        const std::vector<double>& loop = tracers_.back().rays_per_second;
        for (const Tracer& tracer : tracers_) {
            std::vector<double> ratios;
            for (std::size_t i = 0; i < loop.size(); ++i) ratios.push_back(tracer.rays_per_second[i] / loop[i]);
            const Quartiles rate = quartiles_of(tracer.rays_per_second);
            const Quartiles ratio = quartiles_of(ratios);
            std::printf("  %-34s %6.2f Mrays/s, %.2f [%.2f, %.2f] times the loop\n", tracer.name, 1e-6 * rate.median,
                        ratio.median, ratio.lower, ratio.upper);
        }
    }

private:
    PassCounters pass(const Tracer& tracer, std::uint32_t sample) {
        if (!tracer.backend) return loop_.run_pass(camera_, {}, sample);
        return tracer.backend->run_pass({.slot = {},
                                         .features = needed_effects(*scene_),
                                         .path = {},
                                         .camera = camera_,
                                         .sample = sample,
                                         .passes = sample + 1});
    }

    Camera camera_;
    std::shared_ptr<const HostScene> scene_;
    EmbreeLoop& loop_;
    std::vector<Tracer> tracers_;
};

void measure(const std::string& name, int threads) {
    const MachineLoad load;
    const double first_picture = seconds_to_first_picture(name, threads);

    Stopwatch watch;
    const SceneDescription description = load_scene(name, kAssets);
    const double load_seconds = watch.seconds();
    watch = Stopwatch();
    const auto scene = std::make_shared<const HostScene>(pack_scene(description));
    const double pack_seconds = watch.seconds();
    watch = Stopwatch();
    const Bvh bvh = build_bvh(view_of(scene->positions), view_of(scene->triangles));
    const double build_seconds = watch.seconds();
    watch = Stopwatch();
    const WideIntersector wide(scene->view());
    const double wide_seconds = watch.seconds();
    watch = Stopwatch();
    EmbreeLoop loop(*scene, kSide, kSide, threads);
    const double embree_seconds = watch.seconds();

    std::printf("%zu triangles, %d threads: first picture (1280x720, default) after %.2f s\n",
                description.triangles.size(), threads, first_picture);
    std::printf(
        "  reading OBJ %.2f s, packing with own hierarchy %.2f s; own hierarchy %.2f s, made wide %.2f s, Embree's "
        "%.2f s\n",
        load_seconds, pack_seconds, build_seconds, wide_seconds, embree_seconds);
    const auto per_triangle = [&](std::size_t bytes) {
        return static_cast<double>(bytes) / static_cast<double>(scene->triangles.size());
    };
    std::printf("  memory %.1f bytes per triangle, of them %.1f hierarchy; %.1f more for the wide one\n",
                per_triangle(bytes_of(*scene)),
                per_triangle(bvh.nodes.size() * sizeof(BvhNode) + bvh.primitives.size() * sizeof(BvhTriangle)),
                per_triangle(wide.bytes()));
    Race race(description, scene, loop, threads);
    race.run();
    race.print();
    const MachineLoad::Shares shares = load.shares();
    std::printf("  processors: %.2f own, %.2f others, %.2f stolen\n", shares.own, shares.foreign, shares.stolen);
}

}  // namespace
}  // namespace pl::benchmarks

int main(int argc, char** argv) {
    const int threads = argc > 1 ? std::atoi(argv[1]) : 2;
    if (threads < 1) {
        std::fprintf(stderr, "usage: scale_bench [THREADS [SCENE...]]\n");
        return 2;
    }
    for (int i = 2; i < argc; ++i) pl::benchmarks::measure(argv[i], threads);
    if (argc > 2) return 0;
    for (const std::size_t rows : {51u, 159u, 501u}) {
        const pl::test::TemporaryFolder folder;
        pl::benchmarks::measure(pl::test::write_bumpy_ball(folder.path(), rows).string(), threads);
    }
}
