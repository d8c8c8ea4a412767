// The path through the bookmarks: played, and written frame by frame.
#include <cmath>

#include "core/io/camera_file.h"
#include "core/io/image.h"
#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

void add_two(ViewerModel& model) {
    CameraDescription camera = model.camera().camera();
    for (const float x : {1.0f, 3.0f}) {
        camera.eye.x = x;
        model.camera().set(camera);
        model.bookmarks().add();
    }
}

}  // namespace

TEST_CASE("Flight: goes from the first bookmark to the last in its time, and stops there") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    model.flight().toggle();
    CHECK_FALSE(model.flight().is_flying());
    CHECK(told(model, "at least two bookmarks"));
    add_two(model);
    model.flight().seconds_per_camera() = 2.0f;
    model.flight().toggle();
    model.update(10.0);
    CHECK(model.camera().camera().eye.x == 1.0f);
    model.update(11.0);
    CHECK(std::fabs(model.camera().camera().eye.x - 2.0f) < 1.0e-5f);
    CHECK(model.camera().is_moving());
    model.update(12.5);
    CHECK(model.camera().camera().eye.x == 3.0f);
    CHECK_FALSE(model.flight().is_flying());
}

TEST_CASE("Flight: ends when the user moves the camera, and by Esc") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    add_two(model);
    model.flight().toggle();
    model.update(1.0);
    model.camera().look({9.0f, 0.0f});
    const Vec3f target = model.camera().camera().target;
    model.update(1.1);
    CHECK_FALSE(model.flight().is_flying());
    CHECK(model.camera().camera().target == target);
    model.flight().toggle();
    model.update(1.2);
    model.cancel();
    CHECK_FALSE(model.flight().is_flying());
}

TEST_CASE("Sequence: writes every frame with its camera and its samples, and the path beside them") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    model.sequence().begin();
    CHECK_FALSE(model.sequence().progress());
    add_two(model);
    model.render().set_limits({.spp = 9});
    model.sequence().options() = {.frames = 3, .spp = 4, .seconds = 0.0f, .kind = ImageKind::Exr};
    model.sequence().begin();
    CHECK(model.busy());
    const std::filesystem::path folder = model.sequence().folder();
    REQUIRE(bench.run_until(model, [&] { return !model.sequence().progress(); }));
    CHECK(model.render().limits().spp == 9);
    REQUIRE(bench.run_until(model, [&] { return !model.busy(); }));
    CHECK(load_cameras(folder / "cameras.json", {}).size() == 2);
    for (int i = 0; i < 3; ++i) {
        ImageMetadata metadata;
        const LinearImage image = read_exr(folder / ("frame_000" + std::to_string(i + 1) + ".exr"), &metadata);
        CHECK(image.pixels[0].x == 1.0f + static_cast<float>(i));  // the fake picture of the camera's x
        CHECK(text_of(metadata, "spp") == "4");
    }
    CHECK(told(model, "3 frames are in "));
}

TEST_CASE("Sequence: stopped, it keeps the frames so far and the limits of before") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    add_two(model);
    model.sequence().options() = {.frames = 100000, .spp = 2};
    model.sequence().begin();
    REQUIRE(bench.run_until(model, [&] { return model.sequence().progress()->written >= 2; }));
    model.cancel();
    CHECK_FALSE(model.sequence().progress());
    CHECK(model.render().limits() == SampleLimits{});
    CHECK(told(model, "the one under way is lost"));
    REQUIRE(bench.run_until(model, [&] { return !model.busy(); }));
    CHECK(read_png8(model.sequence().folder() / "frame_0001.png").width == 64);
}

TEST_CASE("Sequence: a frame needs a limit") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    add_two(model);
    model.sequence().options() = {.frames = 2, .spp = 0, .seconds = 0.0f};
    model.sequence().begin();
    CHECK_FALSE(model.sequence().progress());
    CHECK(told(model, "a frame needs a limit"));
}
