// How fluid the viewer is: runs the real window on SDL's dummy driver, flies in short hops, and prints percentiles of
// the window's frame times and of the time from a camera move to the first picture that shows it.
// Targets: UI frame p95 below 33 ms while rendering, first picture after a move below 100 ms, at 1280x720.
// Usage: ui_bench [SCENE [HOPS [THREADS]]]
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <fmt/format.h>

#include "core/io/load_scene.h"
#include "core/session/methods.h"
#include "cpu/cpu_backend.h"
#include "ui/viewer.h"

namespace {

using namespace pl;

constexpr int kWidth = 1280;
constexpr int kHeight = 720;
constexpr int kHopFrames = 8;
constexpr int kRestFrames = 45;

/// Hops forward and back with a rest in between: each is a camera move out of a rendering at full size.
void write_script(const std::filesystem::path& path, int hops) {
    std::ofstream script(path);
    script << "0 wait spp >= 2\n";
    int frame = kRestFrames;
    for (int hop = 0; hop < hops; ++hop) {
        const char* key = hop % 2 == 0 ? "W" : "S";
        script << fmt::format("{} key {}\n{} keyup {}\n", frame, key, frame + kHopFrames, key);
        frame += kHopFrames + kRestFrames;
    }
    script << fmt::format("{} quit\n", frame);
}

void run(const std::string& scene_name, const MethodInfo& method, int hops, int threads) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "pathlight-ui-bench";
    std::filesystem::create_directories(folder);
    write_script(folder / "hops.script", hops);

    ViewerOptions options;
    options.scene_name = scene_name;
    options.settings.method = method.id;
    options.settings.width = kWidth;
    options.settings.height = kHeight;
    options.size_from_window = false;
    options.width = kWidth;
    options.height = kHeight;
    options.font = find_assets_dir() / "fonts" / "roboto-medium-latin.ttf";
    options.script = folder / "hops.script";
    options.ui_trace = folder / fmt::format("{}.jsonl", method.name);
    options.make_backend = [threads] { return make_cpu_backend({.threads = threads}); };
    options.load_scene = [](const std::string& name) {
        return std::make_shared<const SceneDescription>(load_scene(name, find_assets_dir()));
    };
    std::fprintf(stderr, "\n%s, %s, %dx%d, %d render %s, trace in %s\n", scene_name.c_str(),
                 std::string(method.name).c_str(), kWidth, kHeight, threads, threads == 1 ? "thread" : "threads",
                 options.ui_trace->c_str());
    run_viewer(options);
}

}  // namespace

int main(int argc, char** argv) {
    const std::string scene = argc > 1 ? argv[1] : "cornell";
    const int hops = argc > 2 ? std::atoi(argv[2]) : 20;
    const int cores = static_cast<int>(std::thread::hardware_concurrency());
    const int threads = argc > 3 ? std::atoi(argv[3]) : (cores > 1 ? cores - 1 : 1);
    for (const MethodInfo& method : all_methods()) run(scene, method, hops, threads);
    return 0;
}
