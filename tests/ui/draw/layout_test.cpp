#include "tests/support/catch.hpp"
#include "ui/draw/layout.h"

using namespace pl;

TEST_CASE("Layout: panels, picture and bars fill the window without overlap") {
    const Layout layout = make_layout(1440.0f, 900.0f, 16.0f, true, false, false);
    CHECK(layout.left.x == 0.0f);
    CHECK(layout.view.x == layout.left.width);
    CHECK(layout.right.x == layout.view.x + layout.view.width);
    CHECK(layout.right.x + layout.right.width == 1440.0f);
    for (const Rect& rect : {layout.left, layout.view, layout.right}) {
        CHECK(rect.y == layout.menu.height);
        CHECK(rect.y + rect.height == layout.status.y);
    }
    CHECK(layout.status.y + layout.status.height == 900.0f);
    const Layout bare = make_layout(1440.0f, 900.0f, 16.0f, false, false, false);
    CHECK(bare.view.width == 1440.0f);
    CHECK(bare.view.height == 900.0f);
    CHECK(bare.left.width == 0.0f);
}

TEST_CASE("Layout: a tab with details gets more of the height than the accuracy panel") {
    const Layout plain = make_layout(1440.0f, 900.0f, 16.0f, true, true, false);
    const Layout detail = make_layout(1440.0f, 900.0f, 16.0f, true, true, true);
    CHECK(plain.right.height < plain.accuracy.height);
    CHECK(detail.right.height > detail.accuracy.height);
    for (const Layout& layout : {plain, detail}) CHECK(layout.right.y + layout.right.height == layout.accuracy.y);
}

TEST_CASE("Layout: in a narrow window the panels shrink, then float over the picture") {
    const Layout narrow = make_layout(1024.0f, 700.0f, 16.0f, true, false, false);
    CHECK(narrow.left.width < 18.0f * 16.0f);
    CHECK(narrow.right.width < 25.0f * 16.0f);
    CHECK(narrow.view.width > 400.0f);
    CHECK(narrow.view.width == narrow.clear.width);
    const Layout floating = make_layout(800.0f, 600.0f, 16.0f, true, false, false);
    CHECK(floating.view.width == 800.0f);
    CHECK(floating.clear.width < 800.0f);
    for (const float width : {1.0f, 100.0f, 400.0f, 640.0f}) {
        const Layout tiny = make_layout(width, 20.0f, 16.0f, true, false, false);
        CHECK(tiny.left.height >= 1.0f);
        CHECK(tiny.left.width + tiny.right.width <= width);
        CHECK(tiny.clear.width >= 0.0f);
    }
}

TEST_CASE("Layout: the picture keeps its shape, and is shown pixel by pixel where it nearly fits") {
    const Rect view{100.0f, 50.0f, 800.0f, 600.0f};
    const Rect wide = place_image(view, 1600, 800);
    CHECK(wide.width == 800.0f);
    CHECK(wide.height == 400.0f);
    CHECK(wide.y == 150.0f);
    const Rect near = place_image(view, 590, 590);
    CHECK(near.width == 590.0f);
    CHECK(near.height == 590.0f);
    const Rect small = place_image(view, 60, 60);
    CHECK(small.width == 600.0f);
    CHECK(place_image(view, 0, 0).width == 0.0f);
    CHECK(fit_image(view, 512, 512).width == 600);
    CHECK(fit_image(view, 512, 512).height == 600);
    CHECK(fit_image(view, 1600, 900).width == 800);
    CHECK(fit_image(view, 1600, 900).height == 450);
    CHECK(fit_image({0, 0, 10, 10}, 1, 1).width == 64);
}
