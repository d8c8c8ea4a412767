#include "ui/model/camera_motion.h"

#include <cmath>

#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"
#include "ui/input/perform_action.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

CameraDescription home_camera() {
    CameraDescription camera;
    camera.eye = {278.0f, 273.0f, -800.0f};
    camera.target = {278.0f, 273.0f, 0.0f};
    return camera;
}

void check_close(Vec3f a, Vec3f b, float tolerance) {
    INFO(a.x << " " << a.y << " " << a.z << "  " << b.x << " " << b.y << " " << b.z);
    CHECK(glm::length(a - b) <= tolerance);
}

Vec3f direction(const CameraDescription& camera) { return glm::normalize(camera.target - camera.eye); }

float pitch_deg(const CameraDescription& camera) {
    return std::asin(glm::dot(direction(camera), glm::normalize(camera.up))) * 180.0f / kPi;
}

}  // namespace

TEST_CASE("Camera controls: the way flown in a second does not depend on the frame rate") {
    const MoveKeys keys{.forward = 1.0f, .right = -1.0f, .up = 1.0f, .speed_factor = 4.0f};
    CameraControls slow(home_camera(), 1000.0f);
    CameraControls fast(home_camera(), 1000.0f);
    for (int i = 0; i < 12; ++i) slow.move(keys, 1.0 / 12.0);
    for (int i = 0; i < 240; ++i) fast.move(keys, 1.0 / 240.0);
    // 240 additions to coordinates near 1000 round by half a float each: 240 * 1000 * 2^-24.
    check_close(slow.camera().eye, fast.camera().eye, 0.02f);
    // A fifth of the diagonal per second, times four, for any combination of keys.
    CHECK_THAT(glm::length(slow.camera().eye - home_camera().eye), WithinRel(800.0f, 1.0e-4f));
}

TEST_CASE("Camera controls: a slow frame does not make the camera jump") {
    CameraControls controls(home_camera(), 1000.0f);
    controls.move({.forward = 1.0f}, 30.0);
    CHECK_THAT(glm::length(controls.camera().eye - home_camera().eye), WithinRel(200.0f * 0.1f, 1.0e-4f));
}

TEST_CASE("Camera controls: keys go where they say, and eye and target move together") {
    CameraControls controls(home_camera(), 1000.0f);
    CHECK(controls.move({.forward = 1.0f}, 0.05));
    check_close(controls.camera().eye, {278.0f, 273.0f, -790.0f}, 1.0e-3f);
    controls.go_home();
    // Looking along +z with +y up, right is -x.
    CHECK(controls.move({.right = 1.0f}, 0.05));
    check_close(controls.camera().eye, {268.0f, 273.0f, -800.0f}, 1.0e-3f);
    check_close(direction(controls.camera()), {0.0f, 0.0f, 1.0f}, 1.0e-6f);
    CHECK(controls.move({.up = 1.0f}, 0.05));
    check_close(controls.camera().eye, {268.0f, 283.0f, -800.0f}, 1.0e-3f);
    CHECK_FALSE(controls.move({}, 0.05));
    CHECK_FALSE(controls.move({.forward = 1.0f}, 0.0));
    controls.go_home();
    check_close(controls.camera().eye, home_camera().eye, 0.0f);
}

TEST_CASE("Camera controls: the mouse turns right and down, and keeps the distance to the target") {
    CameraControls controls(home_camera(), 1000.0f);
    controls.look({50.0f, 0.0f});
    CHECK(direction(controls.camera()).x < 0.0f);  // right is -x here
    CHECK_THAT(glm::length(controls.camera().target - controls.camera().eye), WithinRel(800.0f, 1.0e-4f));
    controls.look({0.0f, 30.0f});
    CHECK(direction(controls.camera()).y < 0.0f);
    // Turning back and forth ends where it began.
    controls.look({-50.0f, -30.0f});
    check_close(direction(controls.camera()), {0.0f, 0.0f, 1.0f}, 1.0e-4f);
    // Many small movements turn as far as one large one.
    CameraControls steps(home_camera(), 1000.0f);
    for (int i = 0; i < 100; ++i) steps.look({1.0f, -0.5f});
    CameraControls once(home_camera(), 1000.0f);
    once.look({100.0f, -50.0f});
    check_close(direction(steps.camera()), direction(once.camera()), 1.0e-4f);
}

TEST_CASE("Camera controls: the pitch stops before the pole and a camera that looks straight down can turn") {
    CameraControls controls(home_camera(), 1000.0f);
    for (int i = 0; i < 50; ++i) controls.look({3.0f, -100.0f});
    CHECK_THAT(pitch_deg(controls.camera()), WithinAbs(89.0f, 0.05f));
    for (int i = 0; i < 50; ++i) controls.look({0.0f, 100.0f});
    CHECK_THAT(pitch_deg(controls.camera()), WithinAbs(-89.0f, 0.05f));

    CameraDescription down = home_camera();
    down.target = down.eye - Vec3f{0.0f, 10.0f, 0.0f};
    CameraControls above(down, 1000.0f);
    CHECK(above.move({.forward = 1.0f, .right = 1.0f}, 0.1));
    above.look({10.0f, -10.0f});
    CHECK(std::isfinite(above.camera().target.x));
    CHECK(pitch_deg(above.camera()) > -89.5f);
}

TEST_CASE("Camera controls: speed follows the scene and stays within its limits") {
    CameraControls controls(home_camera(), 1000.0f);
    CHECK_THAT(controls.speed(), WithinRel(200.0f, 1.0e-6f));
    controls.change_speed(1000.0f);
    CHECK_THAT(controls.speed(), WithinRel(10000.0f, 1.0e-6f));
    controls.change_speed(-1000.0f);
    CHECK_THAT(controls.speed(), WithinRel(1.0f, 1.0e-6f));
    // A scene without extent still has a speed.
    CHECK(CameraControls(home_camera(), 0.0f).speed() > 0.0f);
}

TEST_CASE("Camera controls: an orbit keeps the center's distance and its place in the picture, and the horizon") {
    const Vec3f center{250.0f, 200.0f, 100.0f};
    CameraControls controls(home_camera(), 1000.0f);
    const auto seen = [&] {  // in the camera's own frame
        const CameraDescription& camera = controls.camera();
        const Vec3f forward = direction(camera);
        const Vec3f right = glm::normalize(glm::cross(forward, camera.up));
        const Vec3f away = center - camera.eye;
        return Vec3f{glm::dot(away, right), glm::dot(away, glm::cross(right, forward)), glm::dot(away, forward)};
    };
    const Vec3f before = seen();
    for (const Vec2f pixels :
         {Vec2f{40.0f, 0.0f}, Vec2f{0.0f, -60.0f}, Vec2f{-333.0f, 20.0f}, Vec2f{10.0f, 5000.0f}}) {
        controls.orbit(pixels, center);
        check_close(seen(), before, 0.05f);
        CHECK(std::fabs(pitch_deg(controls.camera())) <= CameraControls::kMaxPitchDeg + 0.01f);
        CHECK(controls.camera().up == home_camera().up);
    }
    // To the right: the scene turns with the pointer, the camera goes left around it.
    CameraControls right(home_camera(), 1000.0f);
    right.orbit({50.0f, 0.0f}, center);
    const Vec3f own_right = glm::cross(direction(home_camera()), home_camera().up);
    CHECK(glm::dot(right.camera().eye - home_camera().eye, own_right) < 0.0f);
}

TEST_CASE("Camera controls: a pan moves a point at the depth by the pointer's pixels") {
    CameraControls controls(home_camera(), 1000.0f);
    const float depth = 500.0f;
    const float height_px = 400.0f;
    controls.pan({30.0f, -20.0f}, depth, height_px);
    const float per_pixel = 2.0f * depth * std::tan(0.5f * home_camera().fov_deg * kPi / 180.0f) / height_px;
    // Right is -x for a camera that looks along +z with +y up.
    check_close(controls.camera().eye - home_camera().eye, {30.0f * per_pixel, -20.0f * per_pixel, 0.0f}, 1.0e-3f);
    check_close(direction(controls.camera()), direction(home_camera()), 1.0e-6f);
}

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
