// Bookmarks of the camera: kept with their pictures for their scene, in their order.
#include <array>
#include <fstream>

#include "core/io/camera_file.h"
#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"
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
