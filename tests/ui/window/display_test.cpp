#include "ui/window/display.h"

#include <array>

#include "tests/support/catch.hpp"

using namespace pl;
using namespace pl::ui;

TEST_CASE("Window plan: without knowledge of the screen the window has its design size") {
    const WindowOptions plan = plan_window({}, {});
    CHECK(plan.width == 1440);
    CHECK(plan.height == 900);
    CHECK(plan.ui_scale == 1.0f);
}

TEST_CASE("Window plan: the window fits small screens with its title bar") {
    const WindowOptions small = plan_window({}, {.width = 1280, .height = 720, .dots_per_inch = 96.0f});
    CHECK(small.width == 1280);
    CHECK(small.height == 684);
    CHECK(small.ui_scale == 1.0f);
    const WindowOptions laptop = plan_window({}, {.width = 1366, .height = 728, .dots_per_inch = 112.0f});
    CHECK(laptop.width == 1366);
    CHECK(laptop.height == 692);
    CHECK(laptop.ui_scale == 1.0f);
}

TEST_CASE("Window plan: text and window grow on dense screens in halves") {
    const WindowOptions ultra_hd = plan_window({}, {.width = 3840, .height = 2120, .dots_per_inch = 163.0f});
    CHECK(ultra_hd.ui_scale == 1.5f);
    CHECK(ultra_hd.width == 2160);
    CHECK(ultra_hd.height == 1350);
    const WindowOptions dense = plan_window({}, {.width = 2560, .height = 1440, .dots_per_inch = 227.0f});
    CHECK(dense.ui_scale == 2.0f);
    CHECK(dense.width == 2560);
    CHECK(dense.height == 1368);
    // A phone's density on a small screen: panels need their room.
    CHECK(plan_window({}, {.width = 1920, .height = 1080, .dots_per_inch = 400.0f}).ui_scale == 1.5f);
    CHECK(plan_window({}, {.width = 7680, .height = 4320, .dots_per_inch = 400.0f}).ui_scale == kMostUiScale);
    // A television: far away, but of few dots.
    CHECK(plan_window({}, {.width = 1920, .height = 1080, .dots_per_inch = 40.0f}).ui_scale == 1.0f);
}

TEST_CASE("Window plan: sizes and scales that were asked for are taken") {
    const Screen screen{.width = 1280, .height = 720, .dots_per_inch = 200.0f};
    const WindowOptions sized = plan_window({.width = 1600, .height = 1000}, screen);
    CHECK(sized.width == 1600);
    CHECK(sized.height == 1000);
    CHECK(sized.ui_scale == 1.0f);
    const WindowOptions scaled = plan_window({.ui_scale = 1.25f}, screen);
    CHECK(scaled.ui_scale == 1.25f);
    CHECK(scaled.width == 1280);
    CHECK(scaled.height == 675);
}

TEST_CASE("Window plan: a remembered place is corrected for the screens that are there") {
    const ScreenArea first{0, 24, 1920, 1056};
    const ScreenArea second{1920, 0, 1280, 1024};
    const std::array both{first, second};
    const WindowPlace on_second{2000, 100, 1000, 700, false};
    CHECK(place_on_screens(on_second, both) == on_second);
    // Its screen is gone.
    CHECK(place_on_screens(on_second, {&first, 1}) == WindowPlace{920, 100, 1000, 700, false});
    CHECK(place_on_screens({-5000, -5000, 1000, 700, true}, both) == WindowPlace{0, 24, 1000, 700, true});
    // Partly outside, with an edge to grab: as it was.
    const WindowPlace partly{-800, 300, 1000, 700, false};
    CHECK(place_on_screens(partly, both) == partly);
    // Its upper edge is above the screen.
    CHECK(place_on_screens({100, -300, 1000, 700, false}, {&first, 1}).y == 24);
    // Larger than any screen, or too small to use.
    const WindowPlace huge = place_on_screens({-10, 30, 9000, 9000, false}, {&first, 1});
    CHECK(huge.width == 1920);
    CHECK(huge.height == 1056);
    CHECK(place_on_screens({10, 30, 1, 1, false}, both).width == 640);
    CHECK(place_on_screens(on_second, {}) == on_second);
}
