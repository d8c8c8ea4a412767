#include "tests/support/catch.hpp"
#include "tests/ui/plot/plot_frame.h"
#include "ui/plot/plot_drag.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Plot: a press takes hold of cursors and axes, else of the plot") {
    CHECK(drag_at({200.0f, 100.0f}, kPlotFrame, {}, {}) == PlotDrag::Pan);
    CHECK(drag_at({200.0f, 260.0f}, kPlotFrame, {}, {}) == PlotDrag::EqualCost);
    CHECK(drag_at({80.0f, 100.0f}, kPlotFrame, {}, {}) == PlotDrag::EqualError);
    CHECK(drag_at({80.0f, 260.0f}, kPlotFrame, {}, {}) == PlotDrag::None);
    CHECK(drag_at({200.0f, 40.0f}, kPlotFrame, {}, {}) == PlotDrag::None);
    CHECK(drag_at({204.0f, 100.0f}, kPlotFrame, 200.0f, {}) == PlotDrag::EqualCost);
    CHECK(drag_at({220.0f, 100.0f}, kPlotFrame, 200.0f, {}) == PlotDrag::Pan);
    CHECK(drag_at({204.0f, 100.0f}, kPlotFrame, {}, 97.0f) == PlotDrag::EqualError);
}
