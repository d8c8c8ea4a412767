// Axes of the plot: mapping, panning, zooming, fitting.
#include "ui/plot/plot_view.h"

#include <cmath>
#include <limits>

#include "tests/support/catch.hpp"
#include "tests/ui/plot/plot_frame.h"

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

TEST_CASE("Plot: values and places in the window lead to each other") {
    const PlotView view({.x_low = 0.1, .x_high = 100.0, .y_low = 1e-4, .y_high = 1.0});
    const Vec2f corner = view.to_window({0.1, 1e-4}, kPlotFrame);
    CHECK_THAT(corner.x, WithinAbs(100.0, 1e-3));
    CHECK_THAT(corner.y, WithinAbs(250.0, 1e-3));  // low errors are at the bottom
    CHECK_THAT(view.to_window({1.0, 1e-2}, kPlotFrame).x, WithinAbs(200.0, 1e-3));
    CHECK_THAT(view.to_window({1.0, 1e-2}, kPlotFrame).y, WithinAbs(150.0, 1e-3));
    const PlotValue back = view.to_value({250.0f, 75.0f}, kPlotFrame);
    CHECK_THAT(view.to_window(back, kPlotFrame).x, WithinAbs(250.0, 1e-3));
    CHECK_THAT(view.to_window(back, kPlotFrame).y, WithinAbs(75.0, 1e-3));
}

TEST_CASE("Plot: what lies under the pointer stays there while panning and zooming") {
    const PlotView before({.x_low = 0.1, .x_high = 100.0, .y_low = 1e-4, .y_high = 1.0});
    const Vec2f at{170.0f, 90.0f};
    const PlotValue value = before.to_value(at, kPlotFrame);
    PlotView view = before;
    view.zoom(3.0f, at, kPlotFrame);
    CHECK(view.x_axis().high() / view.x_axis().low() < 1000.0);
    CHECK_THAT(view.to_window(value, kPlotFrame).x, WithinAbs(at.x, 1e-2));
    CHECK_THAT(view.to_window(value, kPlotFrame).y, WithinAbs(at.y, 1e-2));
    view.pan({25.0f, -40.0f}, kPlotFrame);
    CHECK_THAT(view.to_window(value, kPlotFrame).x, WithinAbs(at.x + 25.0, 1e-2));
    CHECK_THAT(view.to_window(value, kPlotFrame).y, WithinAbs(at.y - 40.0, 1e-2));
}

TEST_CASE("Plot: no wheel and no drag leads where there is nothing to see") {
    PlotView view({.x_low = 0.1, .x_high = 100.0, .y_low = 1e-4, .y_high = 1.0});
    for (int i = 0; i < 200; ++i) view.zoom(1.0f, {150.0f, 60.0f}, kPlotFrame);
    CHECK_THAT(std::log10(view.x_axis().high() / view.x_axis().low()), WithinAbs(PlotView::kLeastDecades, 1e-6));
    for (int i = 0; i < 400; ++i) view.zoom(-1.0f, {150.0f, 60.0f}, kPlotFrame);
    CHECK_THAT(std::log10(view.y_axis().high() / view.y_axis().low()), WithinAbs(PlotView::kMostDecades, 1e-6));
    for (int i = 0; i < 400; ++i) view.pan({5000.0f, -5000.0f}, kPlotFrame);
    CHECK(view.x_axis().low() > 0.0);
    CHECK(std::isfinite(view.y_axis().high()));
    CHECK_FALSE(view.x_axis().ticks(5).empty());
}

TEST_CASE("Plot: a view kept at the data reaches a decade beyond it, and always overlaps it") {
    const PlotRange data{.x_low = 0.1, .x_high = 100.0, .y_low = 1e-4, .y_high = 1.0};
    PlotView view(data);
    for (int i = 0; i < 50; ++i) view.zoom(-1.0f, {150.0f, 60.0f}, kPlotFrame);
    view.keep_at(data);
    CHECK_THAT(view.x_axis().low(), WithinRel(0.01, 1e-9));
    CHECK_THAT(view.x_axis().high(), WithinRel(1000.0, 1e-9));
    CHECK_THAT(view.y_axis().high(), WithinRel(10.0, 1e-9));
    PlotView moved(data);
    moved.zoom(5.0f, {150.0f, 60.0f}, kPlotFrame);
    const double span = moved.x_axis().high() / moved.x_axis().low();
    moved.pan({-5000.0f, 0.0f}, kPlotFrame);
    moved.keep_at(data);
    CHECK_THAT(moved.x_axis().high(), WithinRel(1000.0, 1e-9));  // moved, not stretched
    CHECK_THAT(moved.x_axis().high() / moved.x_axis().low(), WithinRel(span, 1e-9));
    PlotView inside({.x_low = 1.0, .x_high = 10.0, .y_low = 1e-3, .y_high = 0.1});
    inside.keep_at(data);
    CHECK_THAT(inside.x_axis().low(), WithinRel(1.0, 1e-9));
    CHECK_THAT(inside.y_axis().high(), WithinRel(0.1, 1e-9));
}

TEST_CASE("Plot: the fitted range is rounded to ticks, and there is one for nothing at all") {
    const std::vector<PlotValue> values{{0.12, 3e-3}, {31.0, 0.4}, {0.0, 1.0}, {1.0, -1.0}, {NAN, 1.0}};
    const PlotRange range = fit_range(values);
    CHECK_THAT(range.x_low, WithinRel(0.1, 1e-9));
    CHECK_THAT(range.x_high, WithinRel(50.0, 1e-9));
    CHECK_THAT(range.y_low, WithinRel(2e-3, 1e-9));
    CHECK_THAT(range.y_high, WithinRel(0.5, 1e-9));
    const std::vector<PlotValue> one{{2.0, 5.0}};
    CHECK(fit_range(one).x_low < 2.0);
    CHECK(fit_range(one).y_high > 5.0);
    CHECK(fit_range(std::span<const PlotValue>{}).x_low > 0.0);
}
