#include "tests/support/catch.hpp"
#include "ui/window/frame_pacing.h"

using namespace pl;
using namespace pl::ui;

namespace {

constexpr WindowActivity kRendering{};
constexpr WindowActivity kAtRest{.is_at_rest = true};

}  // namespace

TEST_CASE("Frame pacing: sixty frames per second, and a long sleep at rest") {
    FramePacing pacing(10.0);
    CHECK(pacing.sleep_seconds(10.001, kRendering) == Approx(FramePacing::kFrameSeconds - 0.001));
    CHECK(pacing.sleep_seconds(10.001, kAtRest) == FramePacing::kIdleWaitSeconds);
    CHECK(pacing.sleep_seconds(10.001, {.is_scripted = true, .is_at_rest = true}) < FramePacing::kFrameSeconds);
    CHECK(pacing.sleep_seconds(10.001, {.is_working = true, .is_at_rest = true}) < FramePacing::kFrameSeconds);
    pacing.note_event(10.0);  // panels have to settle first
    CHECK(pacing.sleep_seconds(10.001, kAtRest) < FramePacing::kFrameSeconds);
    CHECK(pacing.begin(10.02) == Approx(0.02));
    CHECK(pacing.begin(10.05) == Approx(0.03));
}

TEST_CASE("Frame pacing: a frame is drawn for a new picture, after events, and now and then") {
    FramePacing pacing(10.0);
    CHECK(pacing.needs_redraw(10.0, 1, kRendering));
    CHECK(pacing.end(10.0) == -1.0);
    CHECK_FALSE(pacing.needs_redraw(10.01, 1, kRendering));
    CHECK(pacing.needs_redraw(10.02, 2, kRendering));
    CHECK(pacing.end(10.02) == Approx(0.02));
    CHECK(pacing.needs_redraw(10.13, 2, kRendering));  // counters change without a new picture
    pacing.note_event(10.14);
    CHECK(pacing.needs_redraw(10.15, 2, kRendering));
    CHECK(pacing.needs_redraw(10.15, 2, {.has_toasts = true}));
    pacing.set_hidden(true);
    CHECK_FALSE(pacing.needs_redraw(10.16, 3, kRendering));
}
