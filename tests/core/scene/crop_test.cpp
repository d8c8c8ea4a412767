// Cameras of parts of pictures: they have the rays of the whole.
#include "core/scene/crop.h"

#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"

using namespace pl;

namespace {

/// Largest difference between directions through the pixels' corners of a window, by its camera and by the camera of the whole.
float difference(const CameraDescription& whole, int width, int height, const CropWindow& window) {
    const Camera all = make_camera(whole, width, height);
    const auto columns = static_cast<int>(window.width);
    const auto rows = static_cast<int>(window.height);
    const Camera part =
        make_camera(cropped(whole, static_cast<float>(width), static_cast<float>(height), window), columns, rows);
    float largest = 0.0f;
    for (const float x : {0.0f, 0.5f, 1.0f})
        for (const float y : {0.0f, 0.25f, 1.0f}) {
            const Vec2f film(x * window.width, y * window.height);
            const Ray own = generate_ray(part, film, {window.width, window.height});
            const Ray expected = generate_ray(all, film + Vec2f(window.x, window.y),
                                              {static_cast<float>(width), static_cast<float>(height)});
            CHECK(own.origin == expected.origin);
            largest = std::max(largest, glm::length(own.direction - expected.direction));
        }
    return largest;
}

}  // namespace

TEST_CASE("Crop: rays through the pixels of a window are those of the whole picture") {
    CameraDescription camera{.eye = {1, 2, 3}, .target = {0, 0, -4}, .up = {0, 1, 0}, .fov_deg = 50};
    for (const glm::vec2 shift : {glm::vec2(0.0f), glm::vec2(0.4f, -0.3f)})
        for (const bool is_mirrored : {false, true}) {
            camera.shift = shift;
            camera.is_mirrored = is_mirrored;
            CAPTURE(shift.x, is_mirrored);
            CHECK(difference(camera, 640, 360, {0, 0, 640, 360}) == 0.0f);
            CHECK(difference(camera, 640, 360, {320, 45, 160, 90}) < 1e-6f);
            CHECK(difference(camera, 640, 360, {0, 359, 640, 1}) < 1e-6f);
            CHECK(difference(camera, 640, 360, {639, 0, 1, 1}) < 1e-6f);
            CHECK(difference(camera, 100, 300, {10, 20, 90, 200}) < 1e-6f);
        }
}

TEST_CASE("Crop: a crop of a crop is a crop of the whole, and the whole picture changes nothing") {
    const CameraDescription camera{.fov_deg = 70, .shift = {0.1f, 0.2f}};
    const CameraDescription whole = cropped(camera, 200, 100, {0, 0, 200, 100});
    CHECK(whole.fov_deg == camera.fov_deg);
    CHECK(whole.shift == camera.shift);
    const CameraDescription twice = cropped(cropped(camera, 200, 100, {50, 10, 100, 80}), 100, 80, {20, 30, 40, 50});
    const CameraDescription once = cropped(camera, 200, 100, {70, 40, 40, 50});
    CHECK_THAT(twice.fov_deg, Catch::Matchers::WithinRel(once.fov_deg, 1e-5f));
    CHECK(glm::length(twice.shift - once.shift) < 1e-5f);
}
