#include "ui/draw/draw_list.h"

#include <cmath>

#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"

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

TEST_CASE("Curve: the scale shows all points, passes by their logarithm") {
    const std::vector<PassPoint> points{{1.0, 3.0}, {10.0, 1.0}, {100.0, 0.5}};
    const PassScale scale = scale_of(points, 0.0);
    const Rect rect{10.0f, 20.0f, 200.0f, 110.0f};
    CHECK(scale.first == 1.0);
    CHECK(scale.last == 100.0);
    CHECK_THAT(scale.place(rect, 1.0, 0.0).x, WithinAbs(10.0f, 1.0e-3f));
    CHECK_THAT(scale.place(rect, 10.0, 0.0).x, WithinAbs(110.0f, 1.0e-3f));
    CHECK_THAT(scale.place(rect, 100.0, 0.0).x, WithinAbs(210.0f, 1.0e-3f));
    CHECK_THAT(scale.place(rect, 1.0, 0.0).y, WithinAbs(130.0f, 1.0e-3f));
    CHECK_THAT(scale.place(rect, 1.0, 3.0).y, WithinAbs(30.0f, 1.0e-3f));  // a tenth of room above
    // A divergence's interval may reach below 0: it ends at the frame.
    CHECK(scale.place(rect, 1.0, -0.2).y == 130.0f);
    CHECK(scale.place(rect, 1.0e6, 0.0).x == 210.0f);
}

TEST_CASE("Curve: a level is always shown, and a single point or none has a scale") {
    CHECK(scale_of({}, 0.0).top == 1.0);
    CHECK(scale_of({}, 0.0).last > scale_of({}, 0.0).first);
    const std::vector<PassPoint> one{{7.0, 0.25}};
    CHECK(scale_of(one, 1.0).top >= 1.0);
    CHECK(scale_of(one, 1.0).last > 7.0);
}
