// The zoomed picture: one mapping for display, picking and overlays.
// The magnifier's box and its pixels.
#include "ui/draw/picture_zoom.h"

#include <algorithm>
#include <cmath>

#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"

using namespace pl;
using namespace pl::ui;

namespace {

constexpr Rect kZoomedView{100.0f, 50.0f, 640.0f, 400.0f};
constexpr int kZoomedWidth = 320;
constexpr int kZoomedHeight = 240;

PictureZoom zoomed(int notches, Vec2f pointer) {
    PictureZoom zoom;
    zoom.step(notches, pointer, kZoomedView, kZoomedWidth, kZoomedHeight);
    return zoom;
}

}  // namespace

TEST_CASE("Zoom: whole, the picture is where it fits") {
    const Rect fit = place_image(kZoomedView, kZoomedWidth, kZoomedHeight);
    const Rect place = PictureZoom{}.place(kZoomedView, kZoomedWidth, kZoomedHeight);
    CHECK(place.x == fit.x);
    CHECK(place.width == fit.width);
    PictureZoom zoom;
    zoom.pan({50.0f, 50.0f}, kZoomedWidth, kZoomedHeight);
    CHECK(zoom == PictureZoom{});
}

TEST_CASE("Zoom: the point under the pointer stays, and pixels are whole multiples") {
    for (const Vec2f pointer : {Vec2f{420.0f, 250.0f}, Vec2f{200.0f, 100.0f}, Vec2f{600.0f, 420.0f}}) {
        PictureZoom zoom;
        for (int i = 0; i < 12; ++i) {
            const Vec2f before = picture_point(zoom.place(kZoomedView, kZoomedWidth, kZoomedHeight), pointer);
            zoom.step(1, pointer, kZoomedView, kZoomedWidth, kZoomedHeight);
            const Rect place = zoom.place(kZoomedView, kZoomedWidth, kZoomedHeight);
            CHECK(zoom.scale() == std::round(zoom.scale()));
            CHECK(place.width == zoom.scale() * kZoomedWidth);
            CHECK(place.x == std::round(place.x));
            // Rounding of the place to window pixels, in every step.
            const Vec2f off = (picture_point(place, pointer) - before) * Vec2f{place.width, place.height};
            CHECK(std::max(std::fabs(off.x), std::fabs(off.y)) <= 1.0f);
        }
        CHECK(zoom.scale() == 96.0f);
        zoom.step(99, pointer, kZoomedView, kZoomedWidth, kZoomedHeight);
        CHECK(zoom.scale() == PictureZoom::kLargest);
        zoom.step(-99, pointer, kZoomedView, kZoomedWidth, kZoomedHeight);
        CHECK(zoom.is_whole());
    }
}

TEST_CASE("Zoom: a picture larger than the view goes through 1:1, and its key toggles") {
    PictureZoom zoom;
    zoom.step(1, kZoomedView.center(), kZoomedView, 2000, 1500);
    CHECK(zoom.scale() == 1.0f);
    zoom.step(1, kZoomedView.center(), kZoomedView, 2000, 1500);
    CHECK(zoom.scale() == 2.0f);
    zoom.toggle(kZoomedView.center(), kZoomedView, 2000, 1500);
    CHECK(zoom.is_whole());
    zoom.toggle(kZoomedView.center(), kZoomedView, 2000, 1500);
    CHECK(zoom.scale() == 1.0f);
    PictureZoom small;  // shown larger than 1:1 already
    small.toggle(kZoomedView.center(), kZoomedView, 64, 64);
    CHECK(small.scale() > place_image(kZoomedView, 64, 64).width / 64.0f);
}

TEST_CASE("Zoom: panning moves the picture with the pointer and keeps it in reach") {
    PictureZoom zoom = zoomed(6, kZoomedView.center());
    const Rect before = zoom.place(kZoomedView, kZoomedWidth, kZoomedHeight);
    zoom.pan({31.0f, -17.0f}, kZoomedWidth, kZoomedHeight);
    const Rect after = zoom.place(kZoomedView, kZoomedWidth, kZoomedHeight);
    CHECK(std::fabs(after.x - before.x - 31.0f) <= 1.0f);
    CHECK(std::fabs(after.y - before.y + 17.0f) <= 1.0f);
    zoom.pan({1.0e6f, 1.0e6f}, kZoomedWidth, kZoomedHeight);
    CHECK(common_part(zoom.place(kZoomedView, kZoomedWidth, kZoomedHeight), kZoomedView).width > 0.0f);
}

TEST_CASE("Zoom: pixels, window points and the projection of the scene agree") {
    CameraDescription camera;
    camera.eye = {3.0f, 2.0f, 5.0f};
    camera.target = {-1.0f, 0.5f, -2.0f};
    const Camera pinhole = make_camera(camera, kZoomedWidth, kZoomedHeight);
    for (const int notches : {0, 1, 3, 7, 12}) {
        PictureZoom zoom = zoomed(notches, {300.0f, 300.0f});
        zoom.pan({13.0f, 7.0f}, kZoomedWidth, kZoomedHeight);
        const Rect image = zoom.place(kZoomedView, kZoomedWidth, kZoomedHeight);
        const Projection projection(camera, kZoomedWidth, kZoomedHeight, image);
        for (int y = 0; y < kZoomedHeight; y += 17)
            for (int x = 0; x < kZoomedWidth; x += 13) {
                const Rect place = pixel_place(image, {x, y}, kZoomedWidth, kZoomedHeight);
                CHECK(pixel_under(image, place.center(), kZoomedWidth, kZoomedHeight) == PixelPosition{x, y});
                const Vec2f film{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
                const Vec2f clicked = picture_point(image, place.center()) * Vec2f{kZoomedWidth, kZoomedHeight};
                CHECK(glm::length(clicked - film) < 1.0e-2f);
                // What a ray of the pixel meets is drawn over the pixel.
                const Ray ray = generate_ray(pinhole, film, {kZoomedWidth, kZoomedHeight});
                const auto drawn = projection(ray.origin + 5.0f * ray.direction);
                REQUIRE(drawn);
                CHECK(glm::length(drawn->window - place.center()) <
                      0.01f * std::max(image.width / kZoomedWidth, 1.0f) + 0.1f);
                CHECK(glm::length(window_point(image, picture_point(image, drawn->window)) - drawn->window) < 0.1f);
            }
    }
}

TEST_CASE("Zoom: the slices of a magnified picture cover what is seen, each pixel in its place") {
    for (const int notches : {1, 3, 6, 10, 13}) {
        PictureZoom zoom = zoomed(notches, {333.0f, 222.0f});
        zoom.pan({5.0f, 3.0f}, kZoomedWidth, kZoomedHeight);
        const Rect image = zoom.place(kZoomedView, kZoomedWidth, kZoomedHeight);
        const Rect seen = common_part(image, kZoomedView);
        const auto slices = visible_slices(image, kZoomedView, kZoomedWidth, kZoomedHeight);
        REQUIRE(slices.size() <= 9);
        float area = 0.0f;
        for (const PictureSlice& slice : slices) {
            area += slice.place.width * slice.place.height;
            CHECK(slice.x >= 0);
            CHECK(slice.x + slice.width <= kZoomedWidth);
            CHECK(slice.y + slice.height <= kZoomedHeight);
            // Middles of window pixels of the slice, by the slice and by the mapping.
            for (float at = 0.5f; at < slice.place.width; at += 7.0f) {
                const int across =
                    slice.x + static_cast<int>(at / slice.place.width * static_cast<float>(slice.width));
                const PixelPosition pixel =
                    pixel_under(image, {slice.place.x + at, slice.place.y + 0.5f}, kZoomedWidth, kZoomedHeight);
                CHECK(pixel.x == across);
                CHECK(pixel.y == slice.y);
            }
        }
        CHECK(std::fabs(area - seen.width * seen.height) < 1.0f);
    }
    CHECK(visible_slices({0.0f, 0.0f, 100.0f, 100.0f}, {200.0f, 0.0f, 50.0f, 50.0f}, 10, 10).empty());
}

TEST_CASE("Magnifier: the pixel under the pointer is in the middle of a box beside it, inside the view") {
    constexpr Rect kView{100.0f, 50.0f, 800.0f, 600.0f};
    constexpr Rect kImage{150.0f, 60.0f, 700.0f, 560.0f};
    for (float y = 60.5f; y < 620.0f; y += 70.0f)
        for (float x = 150.5f; x < 850.0f; x += 70.0f) {
            const Vec2f pointer{x, y};
            const Magnifier magnifier = make_magnifier(kImage, pointer, 350, 280, kView, 16.0f);
            CAPTURE(x, y);
            CHECK(magnifier.pixel == pixel_under(kImage, pointer, 350, 280));
            CHECK(pixel_under(magnifier.image, magnifier.box.center(), 350, 280) == magnifier.pixel);
            CHECK(magnifier.middle.contains(magnifier.box.center()));
            CHECK_FALSE(magnifier.box.contains(pointer));
            CHECK(magnifier.box.x >= kView.x);
            CHECK(magnifier.box.y >= kView.y);
            CHECK(magnifier.box.x + magnifier.box.width <= kView.x + kView.width);
            CHECK(magnifier.box.y + magnifier.box.height <= kView.y + kView.height);
            // Larger than in the picture, whatever its zoom.
            CHECK(magnifier.image.width > 1.9f * kImage.width);
        }
}
