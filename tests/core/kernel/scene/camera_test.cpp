// The lens: all its rays meet in the plane of focus, and a lens without an aperture is a pinhole.
#include "core/kernel/scene/camera.h"

#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

namespace {

Camera lens(float aperture_radius) {
    return make_camera({.eye = {1, 2, 3},
                        .target = {-2, 1, -4},
                        .fov_deg = 70.0f,
                        .aperture_radius = aperture_radius,
                        .focus_distance = 5.0f},
                       200, 100);
}

}  // namespace

TEST_CASE("All rays of a lens meet in the plane of focus") {
    const Camera camera = lens(0.25f);
    Uniforms random(1);
    float farthest = 0.0f;
    Vec3f sum{0.0f};
    for (int i = 0; i < 100000; ++i) {
        const Vec2f film = random.square() * Vec2f{200, 100};
        const Ray center = generate_ray(camera, film, {200, 100});
        const Ray ray = through_lens(camera, center, random.square());
        const auto in_focus = [&](const Ray& r) {
            const float distance = 5.0f - glm::dot(r.origin - camera.eye, camera.axis);
            return r.origin + (distance / glm::dot(r.direction, camera.axis)) * r.direction;
        };
        REQUIRE(glm::length(in_focus(ray) - in_focus(center)) < 1e-5f);
        REQUIRE(std::fabs(glm::length(ray.direction) - 1.0f) < 1e-6f);
        const Vec3f offset = ray.origin - camera.eye;
        REQUIRE(std::fabs(glm::dot(offset, camera.axis)) < 1e-6f);
        farthest = max_of(farthest, glm::length(offset));
        sum += offset;
    }
    CHECK(farthest <= 0.25f * (1.0f + 1e-6f));
    CHECK(farthest > 0.249f);
    CHECK(glm::length(sum) / 100000.0f < 0.005f);  // six standard errors
}

TEST_CASE("A closed lens gives the rays of a pinhole") {
    const Camera camera = lens(0.0f);
    const Ray center = generate_ray(camera, {30, 40}, {200, 100});
    const Ray ray = through_lens(camera, center, {0.3f, 0.9f});
    CHECK(ray.origin == center.origin);
    CHECK(glm::length(ray.direction - center.direction) < 1e-6f);
}

// The part of a picture that begins at pixel (30, 10) and has 80 x 60 of its 200 x 100 pixels.
TEST_CASE("A shifted picture is a part of a larger one") {
    CameraDescription whole{.eye = {1, 2, 3}, .target = {-2, 1, -4}, .fov_deg = 70.0f};
    CameraDescription part = whole;
    part.fov_deg = 2.0f * glm::degrees(std::atan(0.6f * std::tan(glm::radians(35.0f))));
    part.shift = {(30.0f + 40.0f - 100.0f) / 60.0f, (50.0f - (10.0f + 30.0f)) / 60.0f};
    const Camera from = make_camera(whole, 200, 100);
    const Camera to = make_camera(part, 80, 60);
    Uniforms random(5);
    for (int i = 0; i < 1000; ++i) {
        const Vec2f film = random.square() * Vec2f{80, 60};
        const Ray expected = generate_ray(from, film + Vec2f{30, 10}, {200, 100});
        const Ray ray = generate_ray(to, film, {80, 60});
        REQUIRE(glm::length(ray.direction - expected.direction) < 1e-6f);
        REQUIRE(ray.origin == expected.origin);
    }
    CHECK(to.axis == from.axis);
}

TEST_CASE("Points of a camera ray have its film position, and points behind the camera none") {
    const float shift = GENERATE(0.0f, 0.7f);
    const Camera camera = make_camera(
        {.eye = {1, 2, 3}, .target = {-2, 1, -4}, .fov_deg = 70.0f, .shift = {shift, -0.5f * shift}}, 200, 100);
    const Vec2f resolution{200, 100};
    Uniforms random(3);
    for (int i = 0; i < 10000; ++i) {
        const Vec2f film = random.square() * resolution;
        const Ray ray = generate_ray(camera, film, resolution);
        const float t = random.between(0.1f, 100.0f);
        const FilmPosition position = film_position(camera, ray.origin + t * ray.direction, resolution);
        REQUIRE(position.depth > 0.0f);
        REQUIRE(glm::length(position.film - film) < 1e-3f);
        REQUIRE(std::fabs(position.depth - t * glm::dot(ray.direction, camera.axis)) < 1e-4f * t);
        REQUIRE(film_position(camera, ray.origin - t * ray.direction, resolution).depth <= 0.0f);
    }
    CHECK(film_position(camera, camera.eye, resolution).depth <= 0.0f);
}
