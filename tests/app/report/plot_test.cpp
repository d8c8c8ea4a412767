// Text as markup, and bytes as base64.
// Plots of the report, drawn from known numbers.
#include "app/report/plot.h"

#include "tests/support/catch.hpp"

namespace pl {

TEST_CASE("markup in names is text") {
    CHECK(escape_markup("<a href='x'>\"&\"") == "&lt;a href=&#39;x&#39;&gt;&quot;&amp;&quot;");
    CHECK(escape_markup("").empty());
}

TEST_CASE("base64 of the standard's examples") {
    CHECK(base64("").empty());
    CHECK(base64("f") == "Zg==");
    CHECK(base64("fo") == "Zm8=");
    CHECK(base64("foo") == "Zm9v");
    CHECK(base64("foob") == "Zm9vYg==");
    CHECK(base64("fooba") == "Zm9vYmE=");
    CHECK(base64("foobar") == "Zm9vYmFy");
    CHECK(base64(std::string("\xff\xfe\x00", 3)) == "//4A");
}

}  // namespace pl

namespace pl::test {
namespace {

Plot two_lines() {
    Plot plot{.title = "a <b> & \"c\"", .x_label = "seconds", .y_label = "relMSE", .series = {}};
    plot.series.push_back({.name = "default, cpu",
                           .color = method_color("default"),
                           .style = 0,
                           .line = {{1.0, 1.0, "first"}, {10.0, 0.1, "last"}},
                           .band = {{1.0, 0.9, 1.1}, {10.0, 0.09, 0.11}}});
    plot.series.push_back({.name = "default, cuda",
                           .color = method_color("default"),
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

}  // namespace pl::test
