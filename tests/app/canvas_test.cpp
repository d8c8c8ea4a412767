// Text and rectangles on an 8-bit image, clipped at its borders.
#include "app/canvas.h"
#include "tests/support/catch.hpp"

namespace pl {

TEST_CASE("text is drawn at its place and cut off at the border") {
    Canvas canvas(20, 20, {0, 0, 0});
    canvas.text(2, 1, "I", {255, 255, 255});
    const auto level = [&](int x, int y) {
        return int{canvas.image().rgb[3 * static_cast<std::size_t>(y * 20 + x)]};
    };
    CHECK(level(4, 9) > 200);  // the stem
    CHECK(level(4, 16) == 0);  // below the base line
    CHECK(level(10, 9) == 0);
    CHECK_NOTHROW(canvas.text(-100, 5, "off", {1, 2, 3}));
    CHECK_NOTHROW(canvas.text(15, 15, "gy~\x80", {1, 2, 3}));
    CHECK_NOTHROW(canvas.fill(18, 8, 100, 100, {1, 2, 3}));
}

TEST_CASE("text is as wide as its letters, which differ") {
    CHECK(Canvas::text_width("") == 0);
    CHECK(Canvas::text_width("W") > Canvas::text_width("i") + 4);
    CHECK(Canvas::text_width("Wi") == Canvas::text_width("W") + Canvas::text_width("i"));
}

}  // namespace pl
