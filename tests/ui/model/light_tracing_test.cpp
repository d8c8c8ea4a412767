#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"

using namespace pl;
using namespace pl::test;

TEST_CASE("Light tracing: works while it is shown, rests while it is hidden, and ends with the selection") {
    FileBench bench;
    bench.options.settings.method = MethodId::Reinforcement;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    model.selection().pick({0.5f, 0.65f});
    REQUIRE(bench.run_until(model, [&] { return model.selection().inspection() != nullptr; }));
    LightTracing& light = model.selection().light();
    REQUIRE(bench.run_until(model, [&] { return model.selection().inspection() != nullptr; }));
    CHECK_FALSE(light.is_working());
    CHECK(light.report() == nullptr);

    REQUIRE(bench.run_until(model, [&] {
        light.show();
        return light.report() != nullptr;
    }));
    CHECK(light.failure().empty());
    CHECK(light.report()->paths_per_cell >= kLightGroups);
    CHECK(light.seconds() > 0.0);
    REQUIRE(bench.run_until(model, [&] { return !light.is_working(); }));
    const double seconds = light.seconds();
    REQUIRE(bench.run_until(model, [&] { return model.selection().inspection() != nullptr; }));
    CHECK(light.seconds() == seconds);

    model.selection().deselect();
    REQUIRE(bench.run_until(model, [&] { return light.report() == nullptr; }));
    CHECK_FALSE(light.is_working());
}
