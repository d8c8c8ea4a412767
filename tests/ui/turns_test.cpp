// Two methods in turns, as the viewer model shows and ends them; over fake back ends.
#include "tests/catch.hpp"
#include "tests/ui/model_bench.h"
#include "tests/ui/worker_bench.h"

using namespace pl;
using namespace pl::test;

namespace {

struct TurnsBench : ModelBench {
    TurnsBench() : ModelBench(kSize) {
        options.settings.field.volumes = 16;
        options.settings.field.bins = 16;
    }
};

}  // namespace

TEST_CASE("Viewer model: in turns the picture is split, and each side keeps the newest frame of its method") {
    TurnsBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.frame() != nullptr; }));
    model.set_method(MethodId::Reinforcement);
    model.set_turns(true);
    CHECK(model.turns());
    CHECK(model.window().compare.mode == CompareMode::Split);
    const auto plan = [&] { return model.compare_plan({0.0f, 0.0f, 400.0f, 400.0f}); };
    REQUIRE(bench.run_until(model, [&] { return plan().tiles.size() == 2; }));
    REQUIRE(bench.run_until(model, [&] { return plan().tiles[0].content.frame && plan().tiles[1].content.frame; }));
    CHECK(plan().tiles[0].content.frame->snapshot.slot.method == MethodId::Reinforcement);
    CHECK(plan().tiles[1].content.frame->snapshot.slot.method == MethodId::Default);
    CHECK(model.frame()->snapshot.slot.method == MethodId::Reinforcement);
}

TEST_CASE("Viewer model: choosing a method ends turns, with that method") {
    TurnsBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.frame() != nullptr; }));
    model.set_turns(true);  // default, and what is compared with it
    REQUIRE(bench.run_until(model, [&] { return model.status().turns && model.status().turns->passes[1] > 0; }));
    model.set_method(MethodId::Default);  // the one that it is already
    CHECK_FALSE(model.turns());
    CHECK(bench.run_until(
        model, [&] { return !model.status().turns && model.frame()->snapshot.slot.method == MethodId::Default; }));
    model.set_turns(true);
    model.set_turns(false);
    CHECK_FALSE(model.turns());
    CHECK(model.settings().method == MethodId::Default);
}
