// Lines of the plot: points, bands, thinning, the point under the pointer, dashes.
#include <cmath>
#include <limits>

#include "tests/support/catch.hpp"
#include "tests/ui/hand_made_runs.h"
#include "tests/ui/plot/plot_frame.h"
#include "ui/plot/plot_lines.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

PlotLine line_of(const LiveRun& run) {
    PlotLine line;
    line.run = run.number;
    line.points = plot_points(run, {});
    return line;
}

}  // namespace

TEST_CASE("Plot: hidden runs do not stretch the axes") {
    CHECK(fit_range(std::span<const PlotLine>{}).x_low < fit_range(std::span<const PlotLine>{}).x_high);
    std::vector<PlotLine> lines{line_of(*make_run({})), line_of(*make_run({.error_of_sample = 1e6}))};
    CHECK(fit_range(lines).y_high >= 1e6);
    lines[1].hidden = true;
    CHECK(fit_range(lines).y_high <= 1.0 + 1e-9);
    CHECK(fit_range(std::span<const PlotLine>{}).x_low < fit_range(std::span<const PlotLine>{}).x_high);
}

TEST_CASE("Plot: points that logarithmic axes cannot show are left out") {
    auto run = make_run({.last_sample = 8});
    run->points[1].metrics->relmse = -1e-6;  // below the resolution of the reference
    run->points[2].metrics.reset();
    const std::vector<LinePoint> points = plot_points(*run, {});
    REQUIRE(points.size() == 2);
    CHECK(points[1].index == 3);
}

TEST_CASE("Plot: a band is as wide as the run's own blocks leave open, and absent where that is not known") {
    auto run = make_run({.last_sample = 8});
    run->points[0].relmse_off = 0.1 * run->points[0].metrics->relmse;
    run->points[1].relmse_off = std::numeric_limits<double>::infinity();
    run->points[0].noise_off = 0.2 * run->points[0].noise;
    const std::vector<LinePoint> points = plot_points(*run, {});
    REQUIRE(points.size() == 4);
    CHECK(points[0].high == Approx(points[0].value.y * std::exp(0.2)));
    CHECK(points[0].low == Approx(points[0].value.y * std::exp(-0.2)));
    for (const std::size_t i : {1u, 2u}) {
        CHECK(points[i].low == 0.0);
        CHECK(points[i].high == 0.0);
    }
    const std::vector<LinePoint> noise = plot_points(*run, {ErrorMetric::Noise, CostAxis::Seconds});
    CHECK(noise[0].high == Approx(noise[0].value.y * std::exp(0.4)));
}

TEST_CASE("Plot: thinned lines keep ends, peaks and order") {
    std::vector<LinePoint> points;
    for (std::size_t i = 0; i < 20000; ++i)
        points.push_back({{1.0 + static_cast<double>(i), i == 7777 ? 100.0 : (i == 12345 ? 0.01 : 1.0)}, i});
    const std::vector<LinePoint> thinned = thin_out(points, kMostPoints);
    CHECK(thinned.size() <= kMostPoints);
    CHECK(thinned.front().index == 0);
    CHECK(thinned.back().index == 19999);
    CHECK(std::ranges::is_sorted(thinned, {}, &LinePoint::index));
    CHECK(std::ranges::count(thinned, std::size_t{7777}, &LinePoint::index) == 1);
    CHECK(std::ranges::count(thinned, std::size_t{12345}, &LinePoint::index) == 1);
    CHECK(thin_out({points.begin(), points.begin() + 10}, kMostPoints).size() == 10);
}

TEST_CASE("Plot: the nearest point is found within reach, on lines that are shown") {
    std::vector<PlotLine> lines{line_of(*make_run({})), line_of(*make_run({.number = 2, .error_of_sample = 0.5}))};
    const PlotView view(fit_range(lines));
    const Vec2f at = view.to_window(lines[1].points[3].value, kPlotFrame);
    const auto hit = nearest_point(lines, view, kPlotFrame, at + Vec2f{2.0f, 1.0f}, 10.0f);
    REQUIRE(hit.has_value());
    CHECK(hit->line == 1);
    CHECK(hit->point == 3);
    CHECK_FALSE(nearest_point(lines, view, kPlotFrame, at + Vec2f{0.0f, 300.0f}, 10.0f).has_value());
    lines[1].hidden = true;
    const auto other = nearest_point(lines, view, kPlotFrame, at, 10.0f);
    CHECK((!other || other->line == 0));
    // A point outside of the frame cannot be pointed at.
    PlotView zoomed = view;
    zoomed.pan({-1000.0f, 0.0f}, kPlotFrame);
    CHECK_FALSE(
        nearest_point(lines, zoomed, kPlotFrame, zoomed.to_window(lines[0].points[3].value, kPlotFrame), 10.0f));
}

TEST_CASE("Plot: dashes go on around corners, and gaps stay gaps") {
    const std::vector<Vec2f> corner{{0.0f, 0.0f}, {10.0f, 0.0f}, {10.0f, 10.0f}};
    const std::vector<Vec2f> pieces = dashes(corner, 4.0f, 2.0f);
    REQUIRE(pieces.size() % 2 == 0);
    float drawn = 0.0f;
    for (std::size_t i = 0; i < pieces.size(); i += 2) drawn += glm::length(pieces[i + 1] - pieces[i]);
    // 20 pixels are three dashes with gaps and a rest of two.
    CHECK_THAT(drawn, WithinAbs(3 * 4.0 + 2.0, 1e-4));
    CHECK_THAT(pieces[2].x, WithinAbs(6.0, 1e-5));  // after the first gap
    CHECK(dashes(std::vector<Vec2f>{{1.0f, 1.0f}}, 4.0f, 2.0f).empty());
}
