#include <cmath>

#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"
#include "ui/draw/draw_list.h"

using namespace pl;
using namespace pl::ui;

namespace {

CameraDescription some_camera() {
    CameraDescription camera;
    camera.eye = {3.0f, 2.0f, 5.0f};
    camera.target = {-1.0f, 0.5f, -2.0f};
    camera.up = {0.1f, 1.0f, 0.0f};
    camera.fov_deg = 50.0f;
    return camera;
}

}  // namespace

TEST_CASE("Projection: is the inverse of camera rays") {
    constexpr int kWidth = 320;
    constexpr int kHeight = 200;
    const Rect image{40.0f, 30.0f, 640.0f, 400.0f};
    const CameraDescription camera = some_camera();
    const Camera pinhole = make_camera(camera, kWidth, kHeight);
    const Projection projection(camera, kWidth, kHeight, image);
    for (int i = 0; i < 200; ++i) {
        const auto t = static_cast<float>(i);
        const Vec2f film{std::fmod(37.3f * t, 320.0f), std::fmod(23.7f * t, 200.0f)};
        const Ray ray = generate_ray(pinhole, film, {kWidth, kHeight});
        const auto point = projection(ray.origin + (0.5f + t) * ray.direction);
        REQUIRE(point);
        INFO("film " << film.x << " " << film.y);
        // Rounding of a point 200 units away seen at 640 pixels: far below a hundredth of a pixel.
        CHECK_THAT(point->window.x, WithinAbs(40.0f + 2.0f * film.x, 0.01f));
        CHECK_THAT(point->window.y, WithinAbs(30.0f + 2.0f * film.y, 0.01f));
        CHECK(point->depth > 0.0f);
    }
    CHECK_FALSE(projection(camera.eye - (camera.target - camera.eye)));
    CHECK_FALSE(projection(camera.eye));
}
