#include "tests/support/catch.hpp"
#include "ui/draw/layout.h"

#include <array>

using namespace pl;
using namespace pl::ui;

namespace {

constexpr PanelChoice kNoAccuracy{.accuracy = false};

float right_end(const Rect& rect) { return rect.x + rect.width; }
float low_end(const Rect& rect) { return rect.y + rect.height; }

}  // namespace

TEST_CASE("Layout: panels, picture and bars fill the window without overlap") {
    const Layout layout = make_layout(1440.0f, 900.0f, 16.0f, kNoAccuracy, false);
    CHECK(layout.left.x == 0.0f);
    CHECK(layout.settings_border.x == layout.left.width);
    CHECK(layout.view.x == right_end(layout.settings_border));
    CHECK(layout.right_border.x == right_end(layout.view));
    CHECK(layout.right.x == right_end(layout.right_border));
    CHECK(layout.right.x + layout.right.width == 1440.0f);
    for (const Rect& rect : {layout.left, layout.settings_border, layout.view, layout.right_border}) {
        CHECK(rect.y == layout.menu.height);
        CHECK(low_end(rect) == layout.status.y);
    }
    CHECK(layout.right.y == layout.menu.height);
    CHECK(layout.accuracy_border.y == low_end(layout.right));
    CHECK(low_end(layout.accuracy_border) == layout.status.y);
    CHECK(layout.status.y + layout.status.height == 900.0f);
    const Layout bare = make_layout(1440.0f, 900.0f, 16.0f, {.shown = false}, false);
    CHECK(bare.view.width == 1440.0f);
    CHECK(bare.view.height == 900.0f);
    CHECK(bare.left.width == 0.0f);
}

TEST_CASE("Layout: a tab with details gets more of the height than the accuracy panel") {
    const Layout plain = make_layout(1440.0f, 900.0f, 16.0f, {}, false);
    const Layout detail = make_layout(1440.0f, 900.0f, 16.0f, {}, true);
    CHECK(plain.right.height < plain.accuracy.height);
    CHECK(detail.right.height > detail.accuracy.height);
    // Large text in a small window: the discs are seen, and of the accuracy panel the table.
    constexpr float kLargeEm = 32.0f;
    const Layout low = make_layout(1280.0f, 720.0f, kLargeEm, {}, true);
    CHECK(low.right.height >= 13.5f * kLargeEm);
    CHECK(low.accuracy.height >= 4.5f * kLargeEm);
    for (const Layout& layout : {plain, detail}) {
        CHECK(low_end(layout.right) == layout.accuracy_border.y);
        CHECK(low_end(layout.accuracy_border) == layout.accuracy.y);
        CHECK(low_end(layout.accuracy) == layout.status.y);
    }
}

TEST_CASE("Layout: a whole plot and the discs have room in every window from 1280 x 720 on") {
    constexpr float kDesignEm = 16.0f;
    // The second one is the first below a title bar.
    for (const auto& [width, height, scale] : {std::array{1280.0f, 720.0f, 1.0f}, std::array{1280.0f, 684.0f, 1.0f},
                                               std::array{1440.0f, 900.0f, 1.0f}, std::array{2560.0f, 1440.0f, 2.0f}})
        for (const bool detail : {false, true}) {
            const Layout layout = make_layout(width, height, kDesignEm * scale, {}, detail);
            CHECK(layout.accuracy.height >= 295.0f * scale);
            CHECK(layout.right.height >= (detail ? 315.0f : 200.0f) * scale);
        }
    // A chosen height is not touched.
    const Layout chosen = make_layout(1280.0f, 720.0f, 16.0f, {.accuracy_share = 0.3f}, true);
    CHECK(chosen.accuracy.height < 0.31f * 664.0f);
}

TEST_CASE("Layout: in a narrow window the panels shrink, then float over the picture") {
    const Layout narrow = make_layout(1024.0f, 700.0f, 16.0f, kNoAccuracy, false);
    CHECK(narrow.left.width < 18.0f * 16.0f);
    CHECK(narrow.right.width < 25.0f * 16.0f);
    CHECK(narrow.view.width > 400.0f);
    CHECK(narrow.view.width == narrow.clear.width);
    const Layout floating = make_layout(500.0f, 600.0f, 16.0f, kNoAccuracy, false);
    CHECK(floating.view.width == 500.0f);
    CHECK(floating.clear.width < 500.0f);
    for (const float width : {1.0f, 100.0f, 400.0f, 640.0f}) {
        const Layout tiny = make_layout(width, 20.0f, 16.0f, kNoAccuracy, false);
        CHECK(tiny.view.height >= 1.0f);
        CHECK(tiny.left.width + tiny.right.width <= width);
        CHECK(tiny.clear.width >= 0.0f);
    }
}

TEST_CASE("Layout: where panels and picture have no room one side is folded, the one that was not opened last") {
    PanelChoice choice;
    const auto layout = [&] { return make_layout(1280.0f, 720.0f, 2.0f * 16.0f, choice, false); };
    CHECK(layout().one_side);
    CHECK(layout().left.width == 0.0f);
    CHECK(layout().right.width > 0.0f);
    CHECK(layout().view.width >= 18.0f * 2.0f * 16.0f);
    choice.toggle_settings(true);
    CHECK(layout().left.width > 0.0f);
    CHECK(layout().right.width == 0.0f);
    CHECK(layout().accuracy.width == 0.0f);
    choice.toggle_settings(true);
    CHECK(layout().left.width == 0.0f);
    choice.toggle_settings(true);
    choice.toggle_right(true);
    CHECK(layout().left.width == 0.0f);
    CHECK(layout().right.width > 0.0f);
    // With room both are as they were opened.
    choice.settings = true;
    const Layout wide = make_layout(2560.0f, 1440.0f, 2.0f * 16.0f, choice, false);
    CHECK_FALSE(wide.one_side);
    CHECK(wide.left.width > 0.0f);
    CHECK(wide.right.width > 0.0f);
}

TEST_CASE("Layout: chosen sizes are taken, as far as picture and text have room") {
    const Layout wide = make_layout(1440.0f, 900.0f, 16.0f, {.settings_em = 24.0f, .right_em = 30.0f}, false);
    CHECK(wide.left.width == 384.0f);
    CHECK(wide.right.width == 480.0f);
    for (const float width : {1280.0f, 1440.0f, 2560.0f}) {
        const float em = width >= 2560.0f ? 32.0f : 16.0f;
        for (const float chosen : {0.1f, 1.0f, 17.0f, 40.0f, 1.0e9f}) {
            const PanelChoice choice{.settings_em = chosen, .right_em = chosen, .accuracy_share = chosen};
            const Layout layout = make_layout(width, 720.0f * em / 16.0f, em, choice, false);
            CAPTURE(width, chosen);
            CHECK(layout.left.width >= 16.0f * em);
            CHECK(layout.right.width >= 24.0f * em);  // the titles of the tabs
            CHECK(layout.clear.width >= 18.0f * em);
            CHECK(layout.view.width == layout.clear.width);
            CHECK(layout.right.height >= 8.0f * em);
            CHECK(layout.accuracy.height >= 10.0f * em);
        }
    }
    const Layout tiny = make_layout(400.0f, 60.0f, 16.0f, {.settings_em = 99.0f, .right_em = 99.0f}, true);
    CHECK(right_end(tiny.left) <= tiny.right.x);
    CHECK(low_end(tiny.accuracy) <= 60.0f);
}

TEST_CASE("Layout: a folded panel leaves its border, and its place to the picture") {
    const Layout open = make_layout(1280.0f, 720.0f, 16.0f, {}, false);
    const Layout no_left = make_layout(1280.0f, 720.0f, 16.0f, {.settings = false}, false);
    CHECK(no_left.left.width == 0.0f);
    CHECK(no_left.settings_border.x == 0.0f);
    CHECK(no_left.clear.x == no_left.settings_border.width);
    CHECK(no_left.clear.width > open.clear.width);
    const Layout no_right = make_layout(1280.0f, 720.0f, 16.0f, {.right = false}, false);
    CHECK(no_right.right.width == 0.0f);
    CHECK(no_right.accuracy.width == 0.0f);
    CHECK(right_end(no_right.right_border) == 1280.0f);
    const Layout no_tabs = make_layout(1280.0f, 720.0f, 16.0f, {.tabs = false}, false);
    CHECK(no_tabs.right.height == 0.0f);
    CHECK(no_tabs.accuracy_border.y == no_tabs.menu.height);
    CHECK(low_end(no_tabs.accuracy) == no_tabs.status.y);
    // The right side is never empty.
    CHECK(make_layout(1280.0f, 720.0f, 16.0f, {.tabs = false, .accuracy = false}, false).right.height > 0.0f);
}

TEST_CASE("Layout: a dragged border follows the pointer until something gets too small") {
    const auto layout_of = [](const PanelChoice& choice) {
        return make_layout(1440.0f, 900.0f, 16.0f, choice, false);
    };
    const Layout start = layout_of({});
    const Layout left = layout_of(drag_border({}, Border::Settings, {340.0f, 300.0f}, start, 16.0f));
    CHECK(left.settings_border.center().x == 340.0f);
    CHECK(left.right.width == start.right.width);
    const Layout right = layout_of(drag_border({}, Border::Right, {980.0f, 300.0f}, start, 16.0f));
    CHECK(right.right_border.center().x == 980.0f);
    const Layout below = layout_of(drag_border({}, Border::Accuracy, {1300.0f, 500.0f}, start, 16.0f));
    CHECK_THAT(below.accuracy_border.center().y, Catch::Matchers::WithinAbs(500.0f, 1.0f));
    // To the other end of the window: the panel over there keeps its size.
    const PanelChoice far = drag_border({}, Border::Settings, {1440.0f, 0.0f}, start, 16.0f);
    CHECK(layout_of(far).clear.width >= 18.0f * 16.0f);
    CHECK(layout_of(drag_border({}, Border::Accuracy, {0.0f, 5000.0f}, start, 16.0f)).accuracy.height == 160.0f);
    CHECK(free_border(far, Border::Settings) == PanelChoice{});
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
    CHECK(fit_image(view, 512, 512).x == 600);
    CHECK(fit_image(view, 512, 512).y == 600);
    CHECK(fit_image(view, 1600, 900).x == 800);
    CHECK(fit_image(view, 1600, 900).y == 450);
    CHECK(fit_image({0, 0, 10, 10}, 1, 1).x == 64);
}
