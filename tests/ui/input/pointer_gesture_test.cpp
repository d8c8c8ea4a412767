#include "tests/support/catch.hpp"
#include "ui/input/pointer_gesture.h"

using namespace pl;

TEST_CASE("Pointer gesture: a short press without movement is a click") {
    PointerGesture gesture;
    gesture.press(PointerButton::Left, {100.0f, 100.0f}, 1.0, true);
    CHECK(gesture.move({103.0f, 98.0f}, {3.0f, -2.0f}) == Vec2f{0.0f});
    const auto click = gesture.release(PointerButton::Left, 1.2);
    REQUIRE(click);
    CHECK(*click == Vec2f{100.0f, 100.0f});
}

TEST_CASE("Pointer gesture: a long press or a drag is no click, and the drag loses nothing to the threshold") {
    PointerGesture gesture;
    gesture.press(PointerButton::Left, {100.0f, 100.0f}, 1.0, true);
    CHECK_FALSE(gesture.release(PointerButton::Left, 1.3));

    gesture.press(PointerButton::Left, {100.0f, 100.0f}, 2.0, true);
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
    gesture.press(PointerButton::Left, {10.0f, 10.0f}, 0.0, false);
    CHECK(gesture.move({200.0f, 200.0f}, {190.0f, 190.0f}) == Vec2f{0.0f});
    CHECK_FALSE(gesture.release(PointerButton::Left, 0.1));

    gesture.press(PointerButton::Right, {10.0f, 10.0f}, 1.0, true);
    CHECK(gesture.captured());
    CHECK(gesture.move({11.0f, 10.0f}, {1.0f, 0.0f}) == Vec2f{1.0f, 0.0f});
    gesture.press(PointerButton::Left, {10.0f, 10.0f}, 1.1, true);
    CHECK_FALSE(gesture.release(PointerButton::Left, 1.2));
    CHECK(gesture.captured());
    gesture.cancel();
    CHECK_FALSE(gesture.captured());
}
