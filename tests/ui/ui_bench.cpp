// Responsiveness of the viewer: runs the real window on SDL's dummy driver, flies in short hops, switches back ends,
// and prints percentiles of the window's frame times and of the time from a camera move, or from the key that
// switches, to the first picture that shows it. The same hops without the accuracy panel measure the cost of the
// panel; drags of a material's color have frame times alone.
// Targets: UI frame p95 below 33 ms while rendering, first picture after a move below 100 ms, first picture of the
// other back end below 250 ms, at 1280x720. Two CPU back ends represent any two: the first pass takes the time of a
// CPU.
// Usage: ui_bench [SCENE [HOPS-AND-SWITCHES [THREADS]]], or ui_bench SCENE displays [THREADS]: the cost of showing all that is learned
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "core/io/load_scene.h"
#include "core/session/methods.h"
#include "cpu/cpu_backend.h"
#include "ui/script/ui_trace.h"
#include "ui/viewer.h"

namespace {

using namespace pl;
using namespace pl::ui;

constexpr int kWidth = 1280;
constexpr int kHeight = 720;
constexpr int kHopFrames = 8;
constexpr int kRestFrames = 45;

std::filesystem::path bench_folder() {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "pathlight-ui-bench";
    std::filesystem::create_directories(folder);
    return folder;
}

/// Hops forward and back with a rest in between: each is a camera move out of a rendering at full size. `first`:
/// commands before the hops.
void write_hops(const std::filesystem::path& path, int hops, const std::string& first = "") {
    std::ofstream script(path);
    script << first << "0 wait spp >= 2\n";
    int frame = kRestFrames;
    for (int hop = 0; hop < hops; ++hop) {
        const char* key = hop % 2 == 0 ? "W" : "S";
        script << fmt::format("{} key {}\n{} keyup {}\n", frame, key, frame + kHopFrames, key);
        frame += kHopFrames + kRestFrames;
    }
    script << fmt::format("{} quit\n", frame);
}

/// Switches to and fro. The first one finds no parked picture on the other side and includes a whole pass in its
/// time; with `anew` the picture is restarted just before each, so that all do.
void write_switches(const std::filesystem::path& path, int switches, bool anew) {
    std::ofstream script(path);
    script << "0 wait learned >= 4\n";
    int frame = kRestFrames;
    for (int i = 0; i < switches; ++i) {
        if (anew) script << fmt::format("{} tap R\n", frame);
        script << fmt::format("{} tap B\n", frame + 1);
        script << fmt::format("{} wait shown_backend == {}\n", frame + 3, i % 2 == 0 ? "second" : "cpu");
        frame += kRestFrames;
        script << fmt::format("{} wait shown_spp >= 2\n", frame);
    }
    script << fmt::format("{} quit\n", frame);
}

/// The color of a material is dragged to and fro, a little in every frame.
void write_drags(const std::filesystem::path& path, int drags) {
    std::ofstream script(path);
    script << "0 tap P\n0 wait spp >= 2\n1 aim_at 0.5 0.5 Material\n2 down left\n3 up left\n";
    int frame = kRestFrames;
    for (int drag = 0; drag < drags; ++drag) {
        script << fmt::format("{} aim_at 0.15 0.5 Color\n{} down left\n", frame, frame + 1);
        for (int step = 0; step < kHopFrames; ++step) {
            const double at = 0.15 + (drag % 2 == 0 ? -0.01 : 0.01) * (step + 1);
            script << fmt::format("{} aim_at {} 0.5 Color\n", frame + 2 + step, at);
        }
        script << fmt::format("{} up left\n", frame + 2 + kHopFrames);
        frame += kHopFrames + kRestFrames;
    }
    script << fmt::format("{} quit\n", frame);
}

/// Frames that are measured between the marks of write_displays().
constexpr int kDisplayFrames = 600;

/// Everything that shows what is learned: discs beside the true light and curves over the passes, lobes of four volumes and of 2000
/// volumes, paths of a pixel, and the past, which is played, so that discs and all lobes are made anew five times a second. Hidden: the
/// same rendering without them. Both copy the command line at the first and at the last measured frame: the marks.
void write_displays(const std::filesystem::path& path, bool shown) {
    std::ofstream script(path);
    script << "0 wait learned >= 4\n";
    int frame = kRestFrames;
    const auto click = [&](const std::string& place) {
        script << fmt::format("{} {}\n{} down left\n{} up left\n", frame, place, frame + 1, frame + 2);
        frame += 4;
    };
    if (shown) {
        for (const char* place : {"aim 0.5 0.92", "aim 0.3 0.5", "aim 0.7 0.5", "aim 0.5 0.45"}) {
            click(place);
            frame += kRestFrames;  // until the answer to the click is there, on a busy machine too
            script << fmt::format("{} wait inspected == yes\n{} tap K\n", frame, frame);
            frame += 4;
        }
        script << fmt::format("{} wait inspected == yes\n", frame);
        click("aim_at 0.1 0.5 keep the past");
        script << fmt::format("{} wait key_frames >= 3\n{} tap U\n{} wait flowers >= 1900\n{} tap J\n", frame, frame,
                              frame + 2, frame + 3);
        frame += 5;
        click("aim 0.5 0.6");
        script << fmt::format("{} wait path_lines >= 1\n", frame);
        click("aim_at 0.5 0.5 Volume");
        script << fmt::format("{} wait curve_points >= 3\n", frame);
        click("aim_at 0.5 0.5 play");
    }
    script << fmt::format("{} tap C ctrl\n{} tap C ctrl\n{} quit\n", frame, frame + kDisplayFrames,
                          frame + kDisplayFrames + 2);
}

/// A moment of a run, when the script copied the command line.
struct Mark {
    double seconds = 0.0;  ///< on the steady clock
    std::uint32_t spp = 0;
};

/// The 95th percentile of the work of the frames between two marks, in ms.
double work_between(const std::filesystem::path& trace, double first, double last) {
    std::ifstream file(trace);
    std::vector<double> work;
    for (std::string line; std::getline(file, line);) {
        int frame = 0;
        double t = 0.0;
        double ms = 0.0;
        if (std::sscanf(line.c_str(), R"({"event":"frame","frame":%d,"t":%lf,"work_ms":%lf)", &frame, &t, &ms) == 3 &&
            t >= first && t <= last)
            work.push_back(ms);
    }
    return percentile(work, 0.95);
}

std::vector<Mark> run(const std::string& scene_name, const MethodInfo& method, const std::string& script, int threads,
                      int volumes = 1000) {
    std::vector<Mark> marks;
    ViewerOptions options;
    options.scene_name = scene_name;
    options.settings.method = method.id;
    options.settings.width = kWidth;
    options.settings.height = kHeight;
    options.settings.field.volumes = volumes;
    options.size_from_window = false;
    options.window = {.width = kWidth, .height = kHeight};
    options.font = find_assets_dir() / "fonts" / "roboto-medium-latin.ttf";
    options.script = bench_folder() / (script + ".script");
    options.ui_trace = bench_folder() / fmt::format("{}-{}.jsonl", script, method.name);
    options.backends = {{"cpu", "", ""}, {"second", "", ""}};
    options.make_backend = [threads](const std::string&) { return make_cpu_backend({.threads = threads}); };
    options.make_side_backend = options.make_backend;
    options.load_scene = [](const SceneRequest& request) {
        return std::make_shared<const SceneDescription>(load_scene(request.name, find_assets_dir()));
    };
    std::fprintf(stderr, "\n%s: %s, %s, %dx%d, %d render %s, trace in %s\n", script.c_str(), scene_name.c_str(),
                 std::string(method.name).c_str(), kWidth, kHeight, threads, threads == 1 ? "thread" : "threads",
                 options.ui_trace->c_str());
    const auto start = std::chrono::steady_clock::now();
    options.command_line = [&](const ViewerPicture& picture) {
        marks.push_back(
            {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), picture.spp});
        return std::string();
    };
    run_viewer(options);
    return marks;
}

/// Targets: below 33 ms; at most 10 % of the speed of the renderer.
void compare_displays(const std::string& scene, int threads) {
    double speeds[2] = {};
    for (const bool shown : {false, true}) {
        const std::string name = shown ? "displays" : "displays-hidden";
        write_displays(bench_folder() / (name + ".script"), shown);
        const std::vector<Mark> marks = run(scene, info_of(MethodId::Reinforcement), name, threads, 2000);
        const double seconds = marks.at(1).seconds - marks.at(0).seconds;
        speeds[shown ? 1 : 0] = (marks[1].spp - marks[0].spp) / seconds;
        std::fprintf(stderr, "%s: %.2f passes a second, work per frame p95 %.2f ms\n", name.c_str(),
                     speeds[shown ? 1 : 0],
                     work_between(bench_folder() / fmt::format("{}-reinforcement.jsonl", name), marks[0].seconds,
                                  marks[1].seconds));
    }
    std::fprintf(stderr, "the displays take %.1f %% of the renderer's speed\n",
                 100.0 * (1.0 - speeds[1] / speeds[0]));
}

}  // namespace

int main(int argc, char** argv) {
    const std::string scene = argc > 1 ? argv[1] : "cornell";
    const int hops = argc > 2 ? std::atoi(argv[2]) : 20;
    const int cores = static_cast<int>(std::thread::hardware_concurrency());
    const int threads = argc > 3 ? std::atoi(argv[3]) : (cores > 1 ? cores - 1 : 1);
    if (argc > 2 && std::string(argv[2]) == "displays") {
        compare_displays(scene, threads);
        return 0;
    }
    const std::filesystem::path folder = bench_folder();
    write_hops(folder / "hops.script", hops);
    write_hops(folder / "hops-without-plot.script", hops, "0 tap P\n");
    write_drags(folder / "drags.script", hops);
    write_switches(folder / "switches.script", hops + 1, false);
    write_switches(folder / "switches-anew.script", hops, true);
    for (const MethodInfo& method : all_methods()) run(scene, method, "hops", threads);
    for (const char* script : {"hops-without-plot", "drags"}) run(scene, info_of(MethodId::Default), script, threads);
    for (const char* script : {"switches", "switches-anew"})
        run(scene, info_of(MethodId::Reinforcement), script, threads);
    return 0;
}
