#include "ui/input/input_router.h"

#include "tests/support/catch.hpp"

using namespace pl;
using namespace pl::ui;

TEST_CASE(
    "Pointer gesture: a press without movement is a click, however long: the window may have been busy meanwhile") {
    PointerGesture gesture;
    gesture.press(PointerButton::Left, {100.0f, 100.0f}, true);
    CHECK(gesture.move({103.0f, 98.0f}, {3.0f, -2.0f}) == Vec2f{0.0f});
    const auto click = gesture.release(PointerButton::Left, 3.0);
    REQUIRE(click);
    CHECK(*click == Vec2f{100.0f, 100.0f});
}

TEST_CASE("Pointer gesture: a drag is no click, and loses nothing to the threshold") {
    PointerGesture gesture;
    gesture.press(PointerButton::Left, {100.0f, 100.0f}, true);
    Vec2f total = gesture.move({102.0f, 100.0f}, {2.0f, 0.0f});
    CHECK_FALSE(gesture.turning());
    total += gesture.move({105.0f, 101.0f}, {3.0f, 1.0f});
    CHECK(gesture.turning());
    total += gesture.move({100.0f, 101.0f}, {-5.0f, 0.0f});
    CHECK(total == Vec2f{0.0f, 1.0f});
    CHECK_FALSE(gesture.release(PointerButton::Left, 2.1));
    CHECK(gesture.move({50.0f, 50.0f}, {9.0f, 9.0f}) == Vec2f{0.0f});
}

TEST_CASE("Pointer gesture: who owns a drag is decided at the press") {
    PointerGesture gesture;
    gesture.press(PointerButton::Left, {10.0f, 10.0f}, false);
    CHECK(gesture.move({200.0f, 200.0f}, {190.0f, 190.0f}) == Vec2f{0.0f});
    CHECK_FALSE(gesture.release(PointerButton::Left, 0.1));

    gesture.press(PointerButton::Right, {10.0f, 10.0f}, true);
    CHECK(gesture.captured());
    CHECK(gesture.move({11.0f, 10.0f}, {1.0f, 0.0f}) == Vec2f{1.0f, 0.0f});
    gesture.press(PointerButton::Left, {10.0f, 10.0f}, true);
    CHECK_FALSE(gesture.release(PointerButton::Left, 1.2));
    CHECK(gesture.captured());
    gesture.cancel();
    CHECK_FALSE(gesture.captured());
}

TEST_CASE("Pointer gesture: the meaning of a drag is that of its press") {
    PointerGesture gesture;
    gesture.press(PointerButton::Middle, {100.0f, 100.0f}, true, Drag::Orbit);
    CHECK(gesture.drag() == Drag::Orbit);
    CHECK_FALSE(gesture.captured());
    CHECK(gesture.move({110.0f, 100.0f}, {10.0f, 0.0f}) == Vec2f{10.0f, 0.0f});
    gesture.press(PointerButton::Left, {110.0f, 100.0f}, true, Drag::PanCamera);  // does not interrupt
    CHECK(gesture.drag() == Drag::Orbit);
    CHECK_FALSE(gesture.release(PointerButton::Middle, 1.2));
    CHECK(gesture.drag() == Drag::Look);
    // Only the left button selects.
    gesture.press(PointerButton::Middle, {100.0f, 100.0f}, true, Drag::Orbit);
    CHECK_FALSE(gesture.release(PointerButton::Middle, 2.1));
}

TEST_CASE("Pointer gesture: two clicks in one place within a short time are a double click") {
    PointerGesture gesture;
    const auto click = [&](Vec2f at, double seconds) {
        gesture.press(PointerButton::Left, at, true);
        REQUIRE(gesture.release(PointerButton::Left, seconds + 0.05));
        return gesture.is_double();
    };
    CHECK_FALSE(click({50.0f, 50.0f}, 1.0));
    CHECK(click({51.0f, 50.0f}, 1.2));
    CHECK_FALSE(click({51.0f, 50.0f}, 2.0));
    CHECK_FALSE(click({80.0f, 50.0f}, 2.2));
}
