// Models of ten thousand and of a million triangles: they load, their memory is within the documented limits, and
// every method renders them without an invalid sample.
#include <cmath>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/base/timer.h"
#include "core/io/load_scene.h"
#include "core/scene/pack_scene.h"
#include "core/session/session.h"
#include "cpu/cpu_backend.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/temporary_folder.h"
#include "tests/support/scenes/bumpy_ball.h"
#include "tests/support/session/sessions.h"

using namespace pl;
using namespace pl::test;

namespace {

/// Corners of a closed surface are shared by six triangles each: 6 bytes of positions, then indices 16, plane 32; tree: at
/// most one node of 32 bytes per leaf and inner node, 2 per leaf of a triangle or more, and the triangles of its leaves with their
/// corners.
constexpr double kMostBytesPerTriangle = 6.0 + 16.0 + 32.0 + 2.0 * 32.0 + 48.0;

std::shared_ptr<const SceneDescription> ball(const TemporaryFolder& folder, std::size_t rows) {
    const std::filesystem::path path = write_bumpy_ball(folder.path(), rows);
    auto scene = std::make_shared<const SceneDescription>(load_scene(path.string(), folder.path()));
    REQUIRE(scene->warnings.empty());
    REQUIRE(scene->triangles.size() == ball_triangles(rows) + kBesideBall);
    return scene;
}

double bytes_per_triangle(const HostScene& scene) {
    return static_cast<double>(bytes_of(scene)) / static_cast<double>(scene.triangles.size());
}

/// One pass of every method in a small picture.
void render_with_every_method(const std::shared_ptr<const SceneDescription>& scene) {
    RenderSettings settings{.width = 64, .height = 64, .camera = scene->camera};
    settings.field.precompute_samples = 1;
    Session session(make_cpu_backend(), scene, settings);
    for (const MethodInfo& method : all_methods()) {
        INFO(method.name);
        const FilmSlot slot{method.id, View::Beauty};
        while (session.advance(slot) != Progress::Rendered) continue;
        const Snapshot picture = session.snapshot(slot);
        CHECK(picture.counters.invalid_samples == 0);
        CHECK(picture.counters.path.segments > 64 * 64);
        double sum = 0.0;
        for (const Vec3f& pixel : picture.pixels) sum += static_cast<double>(luminance(pixel));
        CHECK(sum > 0.0);
    }
}

/// Processor time and memory of a process that loads a model from its file and packs it.
struct LoadCost {
    double processor_seconds = 0.0;
    double peak_bytes = 0.0;
    double packed_bytes = 0.0;
};

LoadCost cost_of_loading(std::size_t rows) {
    const TemporaryFolder folder;
    const std::filesystem::path path = write_bumpy_ball(folder.path(), rows);
    int answer[2];
    REQUIRE(::pipe(answer) == 0);
    const ::pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        std::size_t packed = 0;
        try {
            const SceneDescription scene = load_scene(path.string(), folder.path());
            packed = bytes_of(pack_scene(scene));
        } catch (const std::exception&) {
        }
        ::_exit(packed > 0 && ::write(answer[1], &packed, sizeof(packed)) == sizeof(packed) ? 0 : 1);
    }
    int status = 1;
    std::size_t packed = 0;
    ::rusage used{};
    REQUIRE(::wait4(child, &status, 0, &used) == child);
    REQUIRE(status == 0);
    REQUIRE(::read(answer[0], &packed, sizeof(packed)) == sizeof(packed));
    ::close(answer[0]);
    ::close(answer[1]);
    const auto seconds = [](const ::timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return {seconds(used.ru_utime) + seconds(used.ru_stime), 1024.0 * static_cast<double>(used.ru_maxrss),
            static_cast<double>(packed)};
}

/// Time grows as n log n, with a fifth to spare; memory as n, and its peak is at most three times the packed scene.
void check_growth(std::size_t small_rows, std::size_t large_rows) {
    const LoadCost small = cost_of_loading(small_rows);
    const LoadCost large = cost_of_loading(large_rows);
    const auto work = [](std::size_t rows) {
        const auto n = static_cast<double>(ball_triangles(rows));
        return n * std::log(n);
    };
    INFO(small.processor_seconds << " and " << large.processor_seconds << " s, peak " << small.peak_bytes << " and "
                                 << large.peak_bytes << ", packed " << large.packed_bytes << " bytes");
    CHECK(large.processor_seconds <= 3.0 * work(large_rows) / work(small_rows) * small.processor_seconds);
    CHECK(large.peak_bytes <= 3.0 * large.packed_bytes);
}

}  // namespace

TEST_CASE("A model of ten thousand triangles takes the stated memory and renders with every method") {
    const TemporaryFolder folder;
    const auto scene = ball(folder, 51);
    CHECK(bytes_per_triangle(pack_scene(*scene)) < kMostBytesPerTriangle);
    render_with_every_method(scene);
}

TEST_CASE("A model of a million triangles takes the stated memory and renders with every method", "[merge]") {
    const TemporaryFolder folder;
    const auto scene = ball(folder, 501);
    CHECK(bytes_per_triangle(pack_scene(*scene)) < kMostBytesPerTriangle);
    render_with_every_method(scene);
}

// Wall-clock time from opening the file, on two idle cores.
TEST_CASE("A model of a million triangles is on screen after one pass", "[nightly]") {
    const TemporaryFolder folder;
    const std::filesystem::path path = write_bumpy_ball(folder.path(), 501);
    const Stopwatch watch;
    const auto scene = std::make_shared<const SceneDescription>(load_scene(path.string(), folder.path()));
    Session session(make_cpu_backend(), scene, {.width = 1280, .height = 720, .camera = scene->camera});
    while (session.advance(slot_of(session)) != Progress::Rendered) continue;
    CHECK(session.snapshot(slot_of(session)).passes == 1);
    WARN("a million triangles on screen after " << watch.seconds() << " s");
}

TEST_CASE("A file of ten million triangles takes no more for each than one of a million", "[nightly]") {
    constexpr double kNeeded = 12e9;
    if (static_cast<double>(::sysconf(_SC_AVPHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE)) < kNeeded) {
        WARN("skipped: there are no 12 GB of free memory");
        return;
    }
    check_growth(501, 1582);
}
