// Text and rectangles on an 8-bit image, clipped at its borders.
#include "app/canvas.h"
#include "tests/support/catch.hpp"

namespace pl {

TEST_CASE("text is drawn at its place and cut off at the border") {
    Canvas canvas(20, 10, {0, 0, 0});
    canvas.text(1, 1, "I", {255, 255, 255}, 1);
    const auto lit = [&](int x, int y) {
        return canvas.image().rgb[3 * static_cast<std::size_t>(y * 20 + x)] == 255;
    };
    CHECK(lit(3, 1));
    CHECK(lit(3, 7));
    CHECK_FALSE(lit(1, 4));
    CHECK_NOTHROW(canvas.text(-100, 5, "off", {1, 2, 3}));
    CHECK_NOTHROW(canvas.fill(18, 8, 100, 100, {1, 2, 3}));
}

}  // namespace pl
