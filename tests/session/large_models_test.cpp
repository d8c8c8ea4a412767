// Models of ten thousand and of a million triangles: they load, their memory is what is stated, and every method renders
// them without an invalid sample.
#include "core/base/timer.h"
#include "core/io/load_scene.h"
#include "core/scene/pack_scene.h"
#include "core/session/session.h"
#include "cpu/cpu_backend.h"
#include "tests/bumpy_ball.h"
#include "tests/catch.hpp"
#include "tests/io/temporary_folder.h"

using namespace pl;
using namespace pl::test;

namespace {

/// Corners of a closed surface are shared by six triangles each: 6 bytes of positions, then indices 16, plane 20; tree: at
/// most one node of 32 bytes per leaf and inner node, 2 per leaf of a triangle or more, and its list of triangles.
constexpr double kMostBytesPerTriangle = 6.0 + 16.0 + 20.0 + 2.0 * 32.0 + 4.0;

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
        session.apply(EditMethod{method.id});
        while (session.advance() != Progress::Rendered) continue;
        const Snapshot picture = session.snapshot();
        CHECK(picture.counters.invalid_samples == 0);
        CHECK(picture.counters.path.segments > 64 * 64);
        double sum = 0.0;
        for (const Vec3f& pixel : picture.pixels) sum += static_cast<double>(luminance(pixel));
        CHECK(sum > 0.0);
    }
}

}  // namespace

TEST_CASE("A model of ten thousand triangles takes the memory that is stated and renders with every method") {
    const TemporaryFolder folder;
    const auto scene = ball(folder, 51);
    CHECK(bytes_per_triangle(pack_scene(*scene)) < kMostBytesPerTriangle);
    render_with_every_method(scene);
}

TEST_CASE("A model of a million triangles takes the memory that is stated and renders with every method", "[merge]") {
    const TemporaryFolder folder;
    const auto scene = ball(folder, 501);
    CHECK(bytes_per_triangle(pack_scene(*scene)) < kMostBytesPerTriangle);
    render_with_every_method(scene);
}

// The clock of whoever opens a file, on two cores that do nothing else.
TEST_CASE("A model of a million triangles is on screen within five seconds", "[nightly]") {
    const TemporaryFolder folder;
    const std::filesystem::path path = write_bumpy_ball(folder.path(), 501);
    const Stopwatch watch;
    const auto scene = std::make_shared<const SceneDescription>(load_scene(path.string(), folder.path()));
    Session session(make_cpu_backend(), scene, {.width = 1280, .height = 720, .camera = scene->camera});
    while (session.advance() != Progress::Rendered) continue;
    CHECK(session.snapshot().passes == 1);
    INFO(watch.seconds() << " s");
    CHECK(watch.seconds() < 5.0);
}
