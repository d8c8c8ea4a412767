// The plot of runs as files.
#include "ui/plot/save_plot.h"

#include <algorithm>

#include "tests/support/catch.hpp"
#include "tests/ui/hand_made_runs.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

AccuracyModel model_of(Runs runs) {
    auto set = std::make_shared<LiveRunSet>();
    set->runs.assign(runs.begin(), runs.end());
    AccuracyModel model;
    model.update(set, kThisPicture, 0.0);
    return model;
}

std::ptrdiff_t count_of(const std::string& text, const std::string& part) {
    std::ptrdiff_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

}  // namespace

TEST_CASE("Plot as SVG: a curve and a name for each visible run") {
    Runs runs = two_runs();
    const auto special = std::make_shared<LiveRun>(*runs[1]);
    special->label.details = "a < b & c";
    runs[1] = special;
    AccuracyModel model = model_of(runs);
    const std::string both = plot_svg(model);
    CHECK(both.starts_with("<svg "));
    CHECK(both.ends_with("</svg>\n"));
    CHECK(count_of(both, "<polyline") == 2);
    CHECK(both.find("Default CPU") != std::string::npos);
    CHECK(both.find("Reinforcement (a &lt; b &amp; c) CPU") != std::string::npos);
    model.toggle_hidden(1);
    CHECK(count_of(plot_svg(model), "<polyline") == 1);
}

TEST_CASE("Plot as CSV: a line for each point, of this picture alone") {
    Runs runs = two_runs();
    const auto points = static_cast<std::ptrdiff_t>(runs[0]->points.size() + runs[1]->points.size());
    runs.push_back(make_run({.number = 3, .picture = kThisPicture + 1}));
    const std::string text = plot_csv(model_of(runs));
    CHECK(std::ranges::count(text, '\n') == points + 1);
    CHECK(text.starts_with("run,spp,seconds,noise,relmse\nDefault CPU,1,0.1,"));
}
