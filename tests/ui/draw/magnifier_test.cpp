// The magnifier's box and its pixels.
#include "ui/draw/magnifier.h"

#include "tests/support/catch.hpp"

using namespace pl;
using namespace pl::ui;

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
