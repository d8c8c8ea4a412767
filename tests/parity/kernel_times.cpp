// kernel_times [OPTIONS]: how long the device works on each part of a pass, by events: trace, learn, publish and copy, and each
// kernel; and the ceilings of the device. Records for device_tables.py (record.h).
#include <CLI/CLI.hpp>

#include "core/base/error.h"
#include "core/base/timer.h"
#include "core/io/load_scene.h"
#include "core/session/session.h"
#include "cuda/cuda_backend.h"
#include "tests/parity/device_ceiling.h"
#include "tests/parity/launch_timer.h"
#include "tests/parity/record.h"

using namespace pl;
using namespace pl::parity;

namespace {

struct Options {
    std::vector<std::string> scenes{"cornell"};
    int width = 1280;
    int height = 720;
    std::uint32_t passes = 16;
    double megabytes = 1000.0;
};

struct Case {
    std::shared_ptr<const SceneDescription> scene;
    std::string name;
    MethodId method = MethodId::Default;
    bool next_event = false;
};

/// A pass and the frame of its film, as the viewer shows them.
void advance(Session& session, FilmSlot slot) {
    while (session.advance(slot) != Progress::Rendered) continue;
    (void)session.show_film(slot, {}).frame.pixels();
}

/// Bytes that a kernel with one thread per pixel reads and writes for it; 0 for other kernels.
std::size_t bytes_per_pixel(const std::string& kernel) {
    if (kernel == "add_samples" || kernel == "set_samples") return sizeof(Vec3f) + 2 * sizeof(FilmPixel);
    if (kernel == "show_film") return sizeof(FilmPixel) + sizeof(std::uint32_t);
    if (kernel == "read_film") return sizeof(FilmPixel) + sizeof(Vec3f);
    return 0;
}

void print_times(const Case& timed, const Options& options, const std::map<std::string, WorkTime>& times) {
    std::map<Work, double> totals;
    for (const auto& [kernel, time] : times) {
        totals[time.work] += time.milliseconds;
        const std::size_t pixel = bytes_per_pixel(kernel);
        const std::size_t pixels = static_cast<std::size_t>(options.width * options.height) * options.passes;
        Record("kernel")
            .field("case", timed.name)
            .field("kernel", kernel)
            .field("work", name_of(time.work))
            .field("count", time.count)
            .field("ms", time.milliseconds)
            .field("bytes", pixel > 0 ? pixel * pixels : time.bytes);
    }
    for (const Work work : {Work::Trace, Work::Learn, Work::Publish, Work::Copy, Work::Other})
        Record("work")
            .field("case", timed.name)
            .field("work", name_of(work))
            .field("ms_per_pass", totals[work] / static_cast<double>(options.passes));
}

void time_case(const Case& timed, const Options& options) {
    RenderSettings settings;
    settings.method = timed.method;
    settings.next_event = timed.next_event;
    settings.guiding = GuidingRule::Always;
    settings.width = options.width;
    settings.height = options.height;
    settings.camera = timed.scene->camera;
    Session session(make_cuda_backend(), timed.scene, settings);
    const FilmSlot slot = slot_of(settings);
    for (std::uint32_t pass = 0; pass < options.passes; ++pass) advance(session, slot);  // launch sizes settle

    const PassCounters before = session.summary(slot).counters;
    const LaunchTimer timer;
    const Stopwatch watch;
    for (std::uint32_t pass = 0; pass < options.passes; ++pass) advance(session, slot);
    const double seconds = watch.seconds();
    print_times(timed, options, timer.times());
    const PassCounters after = session.summary(slot).counters;
    Record("passes")
        .field("case", timed.name)
        .field("size", fmt::format("{}x{}", options.width, options.height))
        .field("passes", options.passes)
        .field("host_ms_per_pass", 1.0e3 * seconds / static_cast<double>(options.passes))
        .field("segments", after.path.segments - before.path.segments)
        .field("shadow_rays", after.path.shadow_rays - before.path.shadow_rays);
}

void run(const Options& options) {
    (void)make_cuda_backend();  // without a device, its error says why
    const DeviceCeiling ceiling = measure_ceiling(options.megabytes);
    Record("ceiling")
        .field("lane_instructions_per_s", ceiling.lane_instructions_per_second)
        .field("bytes_per_s", ceiling.bytes_per_second);
    for (const std::string& name : options.scenes) {
        const auto scene = std::make_shared<const SceneDescription>(load_scene(name, find_assets_dir()));
        for (const MethodInfo& method : all_methods())
            for (const bool next_event : {false, true})
                time_case({.scene = scene,
                           .name = name + " " + std::string(method.name) + (next_event ? " nee" : ""),
                           .method = method.id,
                           .next_event = next_event},
                          options);
    }
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app{"Times of the device's kernels by events"};
    app.add_option("--scenes", options.scenes, "names of shipped scenes")->delimiter(',');
    app.add_option("--width", options.width)->check(CLI::Range(1, 8192));
    app.add_option("--height", options.height)->check(CLI::Range(1, 8192));
    app.add_option("--passes", options.passes, "timed ones, after as many to warm up")->check(CLI::Range(1, 10000));
    app.add_option("--megabytes", options.megabytes, "of the copy that measures memory")->check(CLI::PositiveNumber);
    CLI11_PARSE(app, argc, argv);
    try {
        run(options);
        return 0;
    } catch (const Error& error) {
        std::fprintf(stderr, "kernel_times: %s\n", error.what());
        return static_cast<int>(error.kind());
    }
}
