#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"

using namespace pl;
using namespace pl::ui;
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

TEST_CASE("Light tracing: the curve has the figures of all key frames, by the same light, and of the present") {
    FileBench bench;
    bench.options.settings.method = MethodId::Reinforcement;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    model.time().set_keeps(true);
    REQUIRE(bench.run_until(model, [&] { return model.time().history()->frames.size() >= 4; }));
    model.render().set_paused(true);
    REQUIRE(bench.run_until(model, [&] { return model.status().state == WorkerState::Paused; }));
    model.selection().pick({0.5f, 0.65f});
    REQUIRE(bench.run_until(model, [&] { return model.selection().inspection() != nullptr; }));
    const LightTracing& light = model.selection().light();
    CHECK(light.curve().empty());
    REQUIRE(bench.run_until(model, [&] {
        model.selection().light().show();
        return light.report() != nullptr;
    }));
    const auto& frames = model.time().history()->frames;
    REQUIRE(light.curve().size() >= frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) CHECK(light.curve()[i].passes == frames[i]->passes());
    for (std::size_t i = 1; i < light.curve().size(); ++i)
        CHECK(light.curve()[i].passes > light.curve()[i - 1].passes);
    model.selection().deselect();
    REQUIRE(bench.run_until(model, [&] { return light.curve().empty(); }));
}
