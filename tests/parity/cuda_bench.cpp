// cuda_bench [SECONDS]: the speed of the CUDA back end on the present device, as one table. Medians of passes;
// each row runs about SECONDS (default 1). Linear search and tree are compared in the same run.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/io/load_scene.h"
#include "core/session/session.h"
#include "cuda/cuda_backend.h"

using namespace pl;

namespace {

double now_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

struct Row {
    double milliseconds = 0.0;  ///< a pass and the update after it
    double paths_per_second = 0.0;
    double ns_per_segment = 0.0;
};

struct Size {
    int width;
    int height;
};

Row measure(const std::shared_ptr<const SceneDescription>& scene, MethodId method, bool next_event, Size size,
            const FieldSettings& field, double seconds) {
    RenderSettings settings;
    settings.method = method;
    settings.next_event = next_event;
    settings.width = size.width;
    settings.height = size.height;
    settings.camera = scene->camera;
    settings.field = field;
    Session session(make_cuda_backend(), scene, settings);
    while (session.passes(slot_of(settings)) < 16)
        session.advance(slot_of(settings));  // launch sizes and tables settle
    const PassCounters before = session.snapshot(slot_of(settings)).counters;
    std::vector<double> passes;
    const double end = now_seconds() + seconds;
    while (passes.size() < 9 || now_seconds() < end) {
        const double start = now_seconds();
        session.advance(slot_of(settings));
        passes.push_back(now_seconds() - start);
    }
    const PassCounters after = session.snapshot(slot_of(settings)).counters;
    const double count = static_cast<double>(passes.size());
    const double pass = median(passes);
    return {.milliseconds = 1.0e3 * pass,
            .paths_per_second = static_cast<double>(after.paths - before.paths) / count / pass,
            .ns_per_segment = 1.0e9 * pass * count / static_cast<double>(after.path.segments - before.path.segments)};
}

void print_row(const std::string& label, const Row& row) {
    std::printf("| %-44s | %9.3f | %9.1f | %9.1f | %9.4f |\n", label.c_str(), row.milliseconds,
                1.0e-6 * row.paths_per_second, 1.0e3 / row.ns_per_segment, row.ns_per_segment);
    std::fflush(stdout);
}

void run(double seconds) {
    const auto backend = make_cuda_backend();
    std::printf("device: %s\n\n| %-44s | ms/pass   | Mpaths/s  | Msegs/s   | ns/seg    |\n|---|---|---|---|---|\n",
                backend->info().device.c_str(), "cornell");
    const auto scene = std::make_shared<const SceneDescription>(load_scene("cornell", find_assets_dir()));
    for (const Size size : {Size{512, 512}, Size{1280, 720}, Size{1920, 1080}})
        for (const MethodInfo& method : all_methods())
            for (const bool next_event : {false, true})
                print_row(std::to_string(size.width) + "x" + std::to_string(size.height) + " " +
                              std::string(method.name) + (next_event ? ", light samples" : ""),
                          measure(scene, method.id, next_event, size, {}, seconds));

    FieldSettings many{.volumes = 20000, .budget_megabytes = 400.0};
    const Row grid = measure(scene, MethodId::Reinforcement, false, {512, 512}, many, seconds);
    many.lookup = Lookup::KdTree;
    const Row tree = measure(scene, MethodId::Reinforcement, false, {512, 512}, many, seconds);
    many.lookup = Lookup::Linear;
    const Row linear = measure(scene, MethodId::Reinforcement, false, {512, 512}, many, seconds);
    print_row("512x512 reinforcement, 20000 volumes, grid", grid);
    print_row("512x512 reinforcement, 20000 volumes, tree", tree);
    print_row("512x512 reinforcement, 20000 volumes, linear", linear);
    const Row plain = measure(scene, MethodId::Default, false, {1920, 1080}, {}, seconds);
    const Row guided = measure(scene, MethodId::Precomputed, false, {1920, 1080}, {}, seconds);
    std::printf("\ntree / grid, time per segment: %.2f\n", tree.ns_per_segment / grid.ns_per_segment);
    std::printf("linear search / tree, time per segment: %.1f\n", linear.ns_per_segment / tree.ns_per_segment);
    std::printf("guided / default segment, 1920x1080: %.2f\n", guided.ns_per_segment / plain.ns_per_segment);
    std::printf("default at 1920x1080: %.0f passes a second\n", 1.0e3 / plain.milliseconds);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        run(argc > 1 ? std::atof(argv[1]) : 1.0);
        return 0;
    } catch (const Error& error) {
        std::fprintf(stderr, "cuda_bench: %s\n", error.what());
        return static_cast<int>(error.kind());
    }
}
