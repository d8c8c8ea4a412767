#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"
#include "ui/input/perform_action.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Camera motion: motion ends a tenth of a second after the last input") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    model.update(1.0);
    model.camera().look({5.0f, 0.0f});
    CHECK(model.camera().is_moving());
    model.update(1.09);
    CHECK(model.camera().is_moving());
    model.camera().look({5.0f, 0.0f});
    model.update(1.18);
    CHECK(model.camera().is_moving());
    model.update(1.20);
    CHECK_FALSE(model.camera().is_moving());
    CHECK(model.camera().generation() == 2);
}

TEST_CASE("Camera motion: the lens is focused on the picked point") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    model.selection().pick({0.5f, 0.65f});
    REQUIRE(bench.run_until(model, [&] { return model.selection().picked().has_value(); }));
    model.camera().focus_on(model.selection().picked()->position);
    const CameraDescription& camera = model.camera().camera();
    const Vec3f forward = glm::normalize(camera.target - camera.eye);
    CHECK(camera.focus_distance == Approx(glm::dot(model.selection().picked()->position - camera.eye, forward)));
}

TEST_CASE("Camera motion: looks at the picked point, and focuses only a lens on it") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    const float focus = model.camera().camera().focus_distance;
    const Vec3f eye = model.camera().camera().eye;
    model.camera().look_at({0.5f, 0.25f, 0.0f});
    CHECK(model.camera().camera().target == Vec3f{0.5f, 0.25f, 0.0f});
    CHECK(model.camera().camera().eye == eye);
    CHECK(model.camera().camera().focus_distance == focus);
    CameraDescription lens = model.camera().camera();
    lens.aperture_radius = 0.1f;
    model.camera().set(lens);
    model.camera().look_at({1.0f, 1.0f, 1.0f});
    CHECK(model.camera().camera().focus_distance == Approx(glm::length(Vec3f{1.0f} - eye)));
    model.camera().look_at(eye);  // nowhere to look
    CHECK(model.camera().camera().target == Vec3f{1.0f});
}

TEST_CASE("Camera motion: Home shows the whole picture first, then the scene's camera") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    model.camera().look({30.0f, 0.0f});
    const Vec3f target = model.camera().camera().target;
    model.window().zoom.step(4, {10.0f, 10.0f}, {0.0f, 0.0f, 64.0f, 64.0f}, 64, 64);
    perform(model, ActionId::CameraHome);
    CHECK(model.window().zoom.is_whole());
    CHECK(model.camera().camera().target == target);
    perform(model, ActionId::CameraHome);
    CHECK(model.camera().camera().target == small_scene()->camera.target);
}
