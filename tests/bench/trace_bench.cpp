// The speed of the CPU back end, next to a plain loop over Embree's single-ray query that does the same work.
// Usage: trace_bench [SCENE [PAIRS]]. Scenes as in bench_scenes.h. Passes of both alternate, and only ratios of neighbors are compared, because
// other work on the machine comes and goes.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/timer.h"
#include "core/fields/place_volumes.h"
#include "core/fields/table_model.h"
#include "core/fields/volume_grid.h"
#include "core/scene/needed_effects.h"
#include "core/scene/pack_scene.h"
#include "cpu/cpu_backend.h"
#include "tests/bench/bench_scenes.h"
#include "tests/bench/embree_loop.h"
#include "tests/bench/machine_load.h"
#include "tests/bench/quartiles.h"

namespace pl::benchmarks {
namespace {

constexpr int kSize = 512;
constexpr int kPassesPerSlice = 2;
constexpr FilmSlot kDefaultFilm{MethodId::Default, View::Beauty};
constexpr FilmSlot kLearningFilm{MethodId::Reinforcement, View::Beauty};

struct Slice {
    double seconds = 0.0;
    PassCounters counters;

    double paths_per_second() const { return static_cast<double>(counters.paths) / seconds; }
    double ns_per_segment() const { return 1e9 * seconds / static_cast<double>(counters.path.segments); }
};

/// Times several passes; pass(sample) returns the counters of one.
template <class Pass>
Slice time_passes(std::uint32_t& sample, Pass&& pass) {
    const Stopwatch watch;
    Slice slice;
    for (int i = 0; i < kPassesPerSlice; ++i) slice.counters += pass(sample++);
    slice.seconds = watch.seconds();
    return slice;
}

class Bench {
public:
    Bench(const SceneDescription& description, int threads, bool next_event)
        : scene_(std::make_shared<const HostScene>(pack_scene(description))),
          camera_(make_camera(description.camera, kSize, kSize)), backend_(make_cpu_backend({.threads = threads})),
          tree_backend_(make_cpu_backend({.threads = threads})), peer_(*scene_, kSize, kSize, threads),
          features_(needed_effects(*scene_)) {
        settings_.next_event = next_event ? 1 : 0;
        if (next_event) features_ = features_.with(Feature::NextEventEstimation);
        HostVolumes volumes = place_volumes(*scene_, {});
        prepare(*tree_backend_, volumes);  // without grids all volumes are searched in the tree
        volumes.grid = build_volume_grid(*scene_, volumes, threads);
        prepare(*backend_, volumes);
    }

    std::string intersector() const { return backend_->info().intersector; }
    Slice run_ours() {
        return time_passes(ours_sample_, [&](std::uint32_t s) { return pass(*backend_, kDefaultFilm, s); });
    }
    Slice run_peer() {
        return time_passes(peer_sample_, [&](std::uint32_t s) { return peer_.run_pass(camera_, settings_, s); });
    }
    Slice run_learning() { return run_learning(*backend_, learning_sample_); }
    Slice run_learning_by_tree() { return run_learning(*tree_backend_, tree_sample_); }
    double mean_of_ours() const {
        double sum = 0.0;
        const FilmReading film = backend_->read_film(kDefaultFilm);
        for (const Vec3f& mean : film.mean) sum += (static_cast<double>(mean.x) + mean.y + mean.z) / 3.0;
        return sum / static_cast<double>(film.mean.size());
    }
    double mean_of_peer() const { return peer_.mean(); }

private:
    void prepare(RenderBackend& backend, const HostVolumes& volumes) {
        const FieldShape shape = make_field_shape(*scene_, {});
        backend.upload_scene(scene_);
        backend.upload_volumes(std::make_shared<const HostVolumes>(volumes), shape);
        backend.upload_field(MethodId::Reinforcement, make_arrays<HostTables>(shape, volumes.normals.size()));
        backend.reset_film(kDefaultFilm, kSize, kSize);
        backend.reset_film(kLearningFilm, kSize, kSize);
    }
    Slice run_learning(RenderBackend& backend, std::uint32_t& sample) {
        return time_passes(sample, [&](std::uint32_t s) {
            const PassCounters counters = pass(backend, kLearningFilm, s);
            backend.update_field(MethodId::Reinforcement);
            return counters;
        });
    }
    PassCounters pass(RenderBackend& backend, FilmSlot slot, std::uint32_t sample) {
        return backend.run_pass({.slot = slot,
                                 .features = features_,
                                 .path = settings_,
                                 .camera = camera_,
                                 .sample = sample,
                                 .passes = sample + 1});
    }

    std::shared_ptr<const HostScene> scene_;
    Camera camera_;
    std::unique_ptr<RenderBackend> backend_;
    std::unique_ptr<RenderBackend> tree_backend_;
    EmbreeLoop peer_;
    FeatureSet features_;
    PathSettings settings_;
    std::uint32_t ours_sample_ = 0;
    std::uint32_t peer_sample_ = 0;
    std::uint32_t learning_sample_ = 0;
    std::uint32_t tree_sample_ = 0;
};

void print_line(const char* label, const char* format, const std::vector<double>& values) {
    const Quartiles q = quartiles_of(values);
    std::printf("  %-34s ", label);
    std::printf(format, q.median);
    std::printf("  [");
    std::printf(format, q.lower);
    std::printf(", ");
    std::printf(format, q.upper);
    std::printf("]\n");
}

void compare(const SceneDescription& description, int threads, bool next_event, int pairs) {
    Bench bench(description, threads, next_event);
    std::vector<double> ours, peer, ratio, ours_ns, peer_ns, learning_ns, learning_ratio, tree_ns, tree_ratio;
    bench.run_ours();
    bench.run_peer();
    for (int i = 0; i < 4; ++i) {
        bench.run_learning();
        bench.run_learning_by_tree();
    }
    const MachineLoad load;
    double ours_length = 0.0;
    double peer_length = 0.0;
    for (int i = 0; i < pairs; ++i) {
        const Slice a = bench.run_ours();
        const Slice b = bench.run_peer();
        const Slice c = bench.run_learning();
        const Slice d = bench.run_learning_by_tree();
        ours.push_back(1e-6 * a.paths_per_second());
        peer.push_back(1e-6 * b.paths_per_second());
        ratio.push_back(a.paths_per_second() / b.paths_per_second());
        ours_ns.push_back(threads * a.ns_per_segment());
        peer_ns.push_back(threads * b.ns_per_segment());
        learning_ns.push_back(threads * c.ns_per_segment());
        learning_ratio.push_back(c.ns_per_segment() / a.ns_per_segment());
        tree_ns.push_back(threads * d.ns_per_segment());
        tree_ratio.push_back(d.ns_per_segment() / a.ns_per_segment());
        ours_length = static_cast<double>(a.counters.path.segments) / static_cast<double>(a.counters.paths);
        peer_length = static_cast<double>(b.counters.path.segments) / static_cast<double>(b.counters.paths);
    }
    std::printf("%d thread%s, next-event estimation %s, %d pairs: median [quartiles]\n", threads,
                threads == 1 ? "" : "s", next_event ? "on" : "off", pairs);
    print_line("back end, Mpaths/s", "%.3f", ours);
    print_line("Embree loop, Mpaths/s", "%.3f", peer);
    print_line("ratio", "%.3f", ratio);
    print_line("back end, thread ns/segment", "%.1f", ours_ns);
    print_line("Embree loop, thread ns/segment", "%.1f", peer_ns);
    print_line("learning, thread ns/segment", "%.1f", learning_ns);
    print_line("learning / default", "%.3f", learning_ratio);
    print_line("by the tree, thread ns/segment", "%.1f", tree_ns);
    print_line("by the tree / default", "%.3f", tree_ratio);
    const MachineLoad::Shares shares = load.shares();
    std::printf("  processors busy: %.2f with this, %.2f with other work, %.2f stolen\n", shares.own, shares.foreign,
                shares.stolen);
    std::printf("  same work: segments per path %.4f and %.4f, mean radiance %.5f and %.5f\n\n", ours_length,
                peer_length, bench.mean_of_ours(), bench.mean_of_peer());
}

}  // namespace
}  // namespace pl::benchmarks

int main(int count, char** arguments) try {
    const std::string name = count > 1 ? arguments[1] : "cornell";
    const int pairs = count > 2 ? std::max(1, std::atoi(arguments[2])) : 15;
    const pl::SceneDescription scene = pl::benchmarks::open_bench_scene(name);
    std::printf("%s, %d x %d\n", scene.name.c_str(), pl::benchmarks::kSize, pl::benchmarks::kSize);
    for (const bool next_event : {false, true})
        for (const int threads : {1, 2}) pl::benchmarks::compare(scene, threads, next_event, pairs);
    return 0;
} catch (const pl::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
