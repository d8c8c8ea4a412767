#include "tests/support/catch.hpp"
#include "ui/plot/plot_drag.h"

using namespace pl;
using namespace pl::ui;

namespace {

constexpr Rect kFrame{100.0f, 50.0f, 300.0f, 200.0f};

}  // namespace

TEST_CASE("Plot: a press takes hold of cursors and axes, else of the plot") {
    CHECK(drag_at({200.0f, 100.0f}, kFrame, {}, {}) == PlotDrag::Pan);
    CHECK(drag_at({200.0f, 260.0f}, kFrame, {}, {}) == PlotDrag::EqualCost);
    CHECK(drag_at({80.0f, 100.0f}, kFrame, {}, {}) == PlotDrag::EqualError);
    CHECK(drag_at({80.0f, 260.0f}, kFrame, {}, {}) == PlotDrag::None);
    CHECK(drag_at({200.0f, 40.0f}, kFrame, {}, {}) == PlotDrag::None);
    CHECK(drag_at({204.0f, 100.0f}, kFrame, 200.0f, {}) == PlotDrag::EqualCost);
    CHECK(drag_at({220.0f, 100.0f}, kFrame, 200.0f, {}) == PlotDrag::Pan);
    CHECK(drag_at({204.0f, 100.0f}, kFrame, {}, 97.0f) == PlotDrag::EqualError);
}
