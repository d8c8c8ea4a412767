// Bookmarks of the camera: kept with their pictures for their scene, in their order.
// The path through the bookmarks: played, and written frame by frame.
#include <array>
#include <cmath>
#include <fstream>

#include "core/io/camera_file.h"
#include "core/io/image.h"
#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"
#include "tests/ui/installed_programs.h"
#include "ui/model/thumbnail.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

void add_at(FileBench& bench, ViewerModel& model, float x) {
    CameraDescription camera = model.camera().camera();
    camera.eye.x = x;
    model.camera().set(camera);
    model.bookmarks().add();
    REQUIRE(bench.run_until(model, [&] { return !model.busy(); }));
}

std::vector<float> places(const ViewerModel& model) {
    std::vector<float> xs;
    for (const CameraDescription& camera : model.bookmarks().cameras()) xs.push_back(camera.eye.x);
    return xs;
}

}  // namespace

TEST_CASE("Bookmarks: are shown again, stepped through in a circle, moved and removed") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    model.bookmarks().step(1);
    CHECK(told(model, "this scene has no bookmarks"));
    for (const float x : {1.0f, 2.0f, 3.0f}) add_at(bench, model, x);
    CHECK(places(model) == std::vector{1.0f, 2.0f, 3.0f});
    CHECK(model.bookmarks().current() == 2u);
    model.bookmarks().step(1);
    CHECK(model.camera().camera().eye.x == 1.0f);
    model.bookmarks().step(-1);
    CHECK(model.camera().camera().eye.x == 3.0f);
    model.bookmarks().show(0);
    add_at(bench, model, 1.5f);  // behind the one that is shown
    CHECK(places(model) == std::vector{1.0f, 1.5f, 2.0f, 3.0f});
    model.bookmarks().move(3, -1);
    model.bookmarks().move(0, -1);
    CHECK(places(model) == std::vector{1.0f, 1.5f, 3.0f, 2.0f});
    model.bookmarks().remove(1);
    model.bookmarks().remove(99);
    CHECK(places(model) == std::vector{1.0f, 3.0f, 2.0f});
    CHECK(model.bookmarks().path()->size() == 3);
}

TEST_CASE("Bookmarks: at first they are the cameras that the file of the scene lists") {
    FileBench bench;
    SceneDescription scene = *small_scene();
    scene.cameras = {{.name = "a", .camera = scene.camera}, {.name = "b", .camera = scene.camera}};
    scene.cameras[0].camera.eye.x = 0.25f;
    scene.cameras[1].camera.eye.x = 0.5f;
    ViewerModel model(bench.options, std::make_shared<const SceneDescription>(scene), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    CHECK(places(model) == std::vector{0.25f, 0.5f});
    add_at(bench, model, 1.0f);
    CHECK(places(model).size() == 3);
}

TEST_CASE("Bookmarks: stay from one start to the next, with their pictures, for their scene only") {
    FileBench bench;
    const std::filesystem::path folder = bench.options.screenshot_dir / "cameras";
    std::filesystem::path file;
    {
        ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
        model.bookmarks().set_folder(folder);
        REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
        for (const float x : {4.0f, 5.0f}) add_at(bench, model, x);
        file = model.bookmarks().file();
    }
    CHECK(load_cameras(file, {}).size() == 2);  // also a file of `replay --path`
    {
        ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
        model.bookmarks().set_folder(folder);
        model.update(bench.clock += 0.1);
        CHECK(places(model) == std::vector{4.0f, 5.0f});
        REQUIRE(model.bookmarks().list()[1].picture);
        CHECK(model.bookmarks().list()[1].picture->width == kThumbnailWidth);
    }
    {
        ViewerOptions other = bench.options;
        other.scene_name = "another";
        ViewerModel model(other, small_scene(), other.settings, 0.0);
        model.bookmarks().set_folder(folder);
        model.update(bench.clock += 0.1);
        CHECK(places(model).empty());
    }
    std::ofstream(file) << "{";
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    model.bookmarks().set_folder(folder);
    model.update(bench.clock += 0.1);
    CHECK(places(model).empty());
    CHECK(told(model, "the bookmarks are not read"));
}

TEST_CASE("Bookmarks: the small picture shows the whole frame") {
    const auto pixels = std::make_shared<std::vector<std::uint32_t>>();
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 320; ++x) pixels->push_back(x < 160 ? 0xffff0000u : 0xff0000ffu);
    const ByteImage image = small_picture({320, 60, [pixels] { return pixels->data(); }});
    const auto color = [&](int x, int y) {
        const std::size_t at = 3 * static_cast<std::size_t>(y * kThumbnailWidth + x);
        return std::array<int, 3>{image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
    };
    CHECK(color(5, 60) == std::array<int, 3>{255, 0, 0});
    CHECK(color(154, 60) == std::array<int, 3>{0, 0, 255});
    CHECK(color(80, 5) == std::array<int, 3>{0, 0, 0});  // the border of a wide picture
}

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

TEST_CASE("Sequence: PNG frames become a film where ffmpeg is installed") {
    InstalledPrograms installed;
    installed.add("ffmpeg", "for last; do :; done\necho \"$@\" > \"$last\"");
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    add_two(model);
    model.sequence().options() = {.frames = 2, .spp = 2};
    model.sequence().begin();
    REQUIRE(bench.run_until(model, [&] { return !model.sequence().progress() && !model.busy(); }));
    CHECK(std::filesystem::exists(model.sequence().folder().string() + ".mp4"));
    CHECK(told(model, "the film is "));
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
