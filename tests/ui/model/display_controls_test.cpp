#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Display controls: exposure and overlays restart nothing") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.status().passes >= 5; }));
    const std::uint64_t generation = model.status().generation;
    model.display().set_exposure(3.0f);
    model.display().set_curve(ToneCurve::Aces);
    model.display().set_cells(true);
    model.display().set_cells_opacity(2.0f);
    model.window().hemisphere = false;
    REQUIRE(bench.run_until(model, [&] { return has_frame(model) && model.frame()->cells != nullptr; }));
    CHECK(model.status().generation == generation);
    CHECK(model.status().passes >= 5);
    CHECK(model.display().cells_opacity() == 1.0f);
    model.display().set_exposure(1000.0f);
    CHECK(model.display().settings().exposure_ev == 16.0f);
}
