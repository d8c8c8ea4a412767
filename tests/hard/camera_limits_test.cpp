// Cameras at their limits: angles, places, lenses, pictures of odd shapes; and what half of a view shows.
#include "tests/hard/hard_scenes.h"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.h"

using namespace pl;
using namespace pl::test;

namespace {

/// Half of space emits: everything beyond x > edge at this distance in front of a camera at the origin that looks along -z.
SceneDescription half_plane(float edge, float distance) {
    SceneDescription scene;
    scene.name = "half plane";
    scene.materials = {{.name = "lamp", .emission = Vec3f{1.0f}}};
    const float far = 1e3f;
    add_own_quad(
        scene, {Vec3f{edge, -far, -distance}, {far, -far, -distance}, {far, far, -distance}, {edge, far, -distance}},
        0);
    scene.camera = {.eye = Vec3f{0.0f}, .target = {0.0f, 0.0f, -1.0f}};
    return scene;
}

}  // namespace

TEST_CASE("Angles of view from a thousandth of a degree to 179.9 see the furnace", "[hard]") {
    SceneDescription scene = furnace_scene(0.5f, 0.5f);
    for (const float fov : {1e-3f, 0.1f, 90.0f, 170.0f, 179.9f})
        for (const glm::vec3 target :
             {glm::vec3{0, 0, -1}, glm::vec3{0, -0.7f, 0}, glm::vec3{0, 0.7f, 0}, glm::vec3{1, 1e-6f, 0}}) {
            scene.camera = {.eye = {0, 0, 0}, .target = target, .up = {0, 1, 0}, .fov_deg = fov};
            const Snapshot picture = picture_of(scene, kEstimators[0], 16, 1, 3);
            INFO("angle " << fov);
            CHECK(count_broken(picture) == 0);
            CHECK(within(worst_pixel(picture, 1.0 - 0.125), 16.0 * 0x1p-24));
        }
}

TEST_CASE("Cameras in walls, on corners and in the plane of a lamp make finite pictures", "[hard]") {
    SceneDescription scene = shipped_scene("cornell");
    const std::vector<glm::vec3> eyes{scene.positions[0],
                                      0.5f * (scene.positions[0] + scene.positions[1]),
                                      {278.0f, 548.8f, 279.5f},
                                      {0.0f, 100.0f, 100.0f},
                                      {213.0f, 548.8f, 227.0f}};
    for (const glm::vec3 eye : eyes) {
        scene.camera.eye = eye;
        scene.camera.target = {278.0f, 273.0f, 279.5f};
        for (const Estimator estimator : {kEstimators[1], kEstimators[5]}) {
            CAPTURE(eye.x, eye.y, eye.z);
            CHECK(count_broken(picture_of(scene, estimator, 64, 4)) == 0);
        }
    }
}

TEST_CASE("Lenses as large as a room, focused near and far, see the furnace", "[hard]") {
    SceneDescription scene = furnace_scene(0.5f, 0.5f);
    scene.camera = {.eye = Vec3f{0.0f}, .target = {0, 0, -1}, .fov_deg = 60.0f};
    for (const float aperture : {1e-6f, 0.3f, 0.7f})
        for (const float focus : {1e-4f, 1.0f, 1e6f}) {
            scene.camera.aperture_radius = aperture;
            scene.camera.focus_distance = focus;
            const Snapshot picture = picture_of(scene, kEstimators[0], 32, 2, 3);
            INFO("aperture " << aperture << ", focus " << focus);
            CHECK(picture.counters.path.escaped == 0);
            CHECK(within(worst_pixel(picture, 1.0 - 0.125), 16.0 * 0x1p-24));
        }
}

TEST_CASE("Pictures of one pixel, one row, one column and odd sizes have every pixel", "[hard]") {
    const SceneDescription scene = furnace_scene(0.5f, 0.5f);
    const std::pair<int, int> sizes[] = {{1, 1}, {1, 257}, {257, 1}, {16384, 1}, {1, 16384}, {31, 33}};
    for (const auto& [width, height] : sizes) {
        RenderSettings settings = settings_for(scene, kEstimators[0], width, height);
        settings.max_depth = 3;
        Session session = make_session(scene, settings, 2);
        render_passes(session, 2);
        const Snapshot picture = session.snapshot(slot_of(session));
        INFO(width << " x " << height);
        CHECK(picture.pixels.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
        CHECK(picture.counters.paths == 2 * picture.pixels.size());
        CHECK(picture.counters.path.zero_directions == 0);
        CHECK(within(worst_pixel(picture, 1.0 - 0.125), 16.0 * 0x1p-24));
    }
}

// One pixel of 90 degrees: the film is 2 wide at distance 1, a quarter or a half of it shows the lamp.
TEST_CASE("A lamp that fills a part of the view fills that part of a pixel", "[hard]") {
    for (const float edge : {0.0f, 0.5f, -0.25f}) {
        SceneDescription scene = half_plane(edge, 1.0f);
        scene.camera.fov_deg = 90.0f;
        RenderSettings settings = settings_for(scene, kEstimators[0], 1, 1);
        settings.max_depth = 1;
        Session session = make_session(scene, settings);
        Picture picture(1, 1, 1);
        render_batches(session, picture, 64, 300);
        INFO("edge " << edge);
        CHECK(mean_equals(picture.channels[1].whole(), {(1.0 - static_cast<double>(edge)) / 2.0, 1e-6}, 0.12));
    }
}

// The disc of a lens, cut by the edge where it is thrown onto the lamp's plane.   [area of a circular segment]
TEST_CASE("The edge of a lamp out of focus falls off as a disc is covered", "[hard]") {
    constexpr float kAperture = 0.1f;
    constexpr float kFocus = 2.0f;
    for (const float distance : {1.0f, 5.0f})
        for (const double cut : {-0.7, 0.0, 0.4, 0.8}) {
            const double spread =
                static_cast<double>(kAperture) * std::fabs(1.0 - static_cast<double>(distance / kFocus));
            SceneDescription scene = half_plane(static_cast<float>(cut * spread), distance);
            scene.camera.fov_deg = 1e-3f;
            scene.camera.aperture_radius = kAperture;
            scene.camera.focus_distance = kFocus;
            const double expected = 0.5 - (cut * std::sqrt(1.0 - cut * cut) + std::asin(cut)) / kHalfTurn;
            INFO("lamp at " << distance << ", cut " << cut);
            // A thousandth of a degree blurs the edge by 1e-5 of its distance.
            CHECK(pixels_mean(picture_of(scene, kEstimators[0], 96, 16, 1), {expected, 1e-3 * expected + 1e-4}, 0.1));
        }
}
