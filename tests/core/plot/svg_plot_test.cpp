// Plots drawn from known numbers.
#include "core/plot/svg_plot.h"

#include "tests/support/catch.hpp"

namespace pl::test {
namespace {

Plot two_lines() {
    Plot plot{.title = "a <b> & \"c\"", .x_label = "seconds", .y_label = "relMSE", .series = {}};
    plot.series.push_back({.name = "default, cpu",
                           .color = 0xff0072b2u,
                           .style = 0,
                           .line = {{1.0, 1.0, "first"}, {10.0, 0.1, "last"}},
                           .band = {{1.0, 0.9, 1.1}, {10.0, 0.09, 0.11}}});
    plot.series.push_back({.name = "default, cuda",
                           .color = 0xff0072b2u,
                           .style = 1,
                           .line = {{0.1, 1.0, ""}, {1.0, 0.1, ""}},
                           .band = {}});
    plot.floor = 0.2;
    return plot;
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

}  // namespace

TEST_CASE("an SVG plot has ticks, units, a legend, one color per method and one style per back end") {
    const std::string svg = svg_plot(two_lines());
    CHECK(svg.starts_with("<svg "));
    CHECK_THAT(svg, contains("a &lt;b&gt; &amp; &quot;c&quot;"));
    for (const char* part : {">seconds<", ">relMSE<", ">default, cpu<", ">default, cuda<", ">0.1<", ">10<",
                             "<title>first</title>", "below the noise of the reference"})
        CHECK_THAT(svg, contains(part));
    CHECK(count(svg, "<polyline") == 2);
    CHECK(count(svg, "<polygon") == 1);
    CHECK(count(svg, "stroke-dasharray=\"8 4\"") == 2);  // line and legend
    CHECK(count(svg, "stroke=\"#0072b2\"") == 4);
    CHECK(count(svg, "nan") + count(svg, "inf") == 0);
    // Both axes are logarithmic: a line of slope -1 over one decade each.
    const PlotLayout layout;
    const Plot plot = two_lines();
    CHECK_THAT(layout.x(plot.x_axis(), 10.0) - layout.x(plot.x_axis(), 1.0),
               WithinRel(layout.x(plot.x_axis(), 1.0) - layout.x(plot.x_axis(), 0.1), 1e-9));
}

TEST_CASE("a plot of nothing is an empty frame") {
    const Plot plot{.title = "none", .x_label = "x", .y_label = "y", .series = {}};
    CHECK_THAT(svg_plot(plot), contains("none"));
    CHECK(svg_plot(plot).find("nan") == std::string::npos);
}

TEST_CASE("A plot of chosen ranges has their axes and clips its curves, and long names widen the file") {
    Plot plot = two_lines();
    plot.series[0].name = std::string(60, 'm');
    plot.x_shown = LogAxis::exactly(1.0, 2.0);
    const std::string svg = svg_plot(plot);
    CHECK_THAT(svg, contains(">1.5<") || contains(">2<"));
    CHECK(svg.find(">10<") == std::string::npos);
    CHECK(count(svg, "<svg ") == 2);               // the inner one clips
    CHECK(svg.find("url(") == std::string::npos);  // a page has several plots, and loads nothing
    const PlotLayout layout;
    CHECK_THAT(svg, contains("width=\"" + std::to_string(layout.width - layout.right + 44 + 8 * 60) + "\""));
}

}  // namespace pl::test
