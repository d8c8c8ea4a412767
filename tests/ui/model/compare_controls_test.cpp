// Comparisons: methods in turns, modes and cursors.
#include "tests/support/catch.hpp"
#include "tests/ui/model_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

struct TurnsBench : ModelBench {
    TurnsBench() : ModelBench(64) {
        options.settings.field.volumes = 16;
        options.settings.field.bins = 16;
    }
};

}  // namespace

TEST_CASE("Compare controls: in turns the picture is split, and each side keeps the newest frame of its method") {
    TurnsBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.frame() != nullptr; }));
    model.render().set_method(MethodId::Reinforcement);
    model.comparison().set_turns(true);
    CHECK(model.comparison().in_turns());
    CHECK(model.comparison().state().mode == CompareMode::Split);
    const auto plan = [&] { return model.comparison().plan({0.0f, 0.0f, 400.0f, 400.0f}); };
    REQUIRE(bench.run_until(model, [&] { return plan().tiles.size() == 2; }));
    REQUIRE(bench.run_until(model, [&] { return plan().tiles[0].content.frame && plan().tiles[1].content.frame; }));
    CHECK(plan().tiles[0].content.frame->snapshot.slot.method == MethodId::Reinforcement);
    CHECK(plan().tiles[1].content.frame->snapshot.slot.method == MethodId::Default);
    CHECK(model.frame()->snapshot.slot.method == MethodId::Reinforcement);
}

TEST_CASE("Compare controls: choosing a method ends turns, with that method") {
    TurnsBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.frame() != nullptr; }));
    model.comparison().set_turns(true);  // the default method and the one compared with it
    REQUIRE(bench.run_until(model, [&] { return model.status().turns && model.status().turns->passes[1] > 0; }));
    model.render().set_method(MethodId::Default);  // the present method
    CHECK_FALSE(model.comparison().in_turns());
    CHECK(bench.run_until(
        model, [&] { return !model.status().turns && model.frame()->snapshot.slot.method == MethodId::Default; }));
    model.comparison().set_turns(true);
    model.comparison().set_turns(false);
    CHECK_FALSE(model.comparison().in_turns());
    CHECK(model.render().settings().method == MethodId::Default);
}
