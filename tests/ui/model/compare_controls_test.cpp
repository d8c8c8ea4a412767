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

TEST_CASE("Compare controls: the run chosen as B goes on beside the present one, each side with its name and color") {
    TurnsBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    model.render().set_method(MethodId::Reinforcement);
    const auto run_of = [&](int volumes) {
        std::shared_ptr<const LiveRun> found;
        for (const auto& run : model.comparison().accuracy().runs())
            if (run->label.method == MethodId::Reinforcement && run->settings.field.volumes == volumes &&
                run->points.size() > 1)
                found = run;
        return found;
    };
    REQUIRE(bench.run_until(model, [&] { return run_of(16) != nullptr; }));
    FieldSettings field = model.render().settings().field;
    field.volumes = 24;
    model.render().set_field(field);
    REQUIRE(bench.run_until(model, [&] { return run_of(24) != nullptr; }));
    // The present run itself is no other side.
    model.comparison().choose_side(true, {SideChoice::What::Run, run_of(24)->number});
    model.comparison().set_turns(true);
    CHECK_FALSE(model.comparison().in_turns());
    CHECK(told(model, "the run chosen as B is the present one"));
    model.comparison().choose_side(true, {SideChoice::What::Run, run_of(16)->number});
    const std::uint64_t before = run_of(16)->number;
    model.comparison().set_turns(true);
    REQUIRE(model.link().turns());
    REQUIRE(model.link().turns()->second);
    CHECK(model.link().turns()->second->field.volumes == 16);
    const auto plan = [&] { return model.comparison().plan({0.0f, 0.0f, 400.0f, 400.0f}); };
    REQUIRE(bench.run_until(model, [&] {
        const ComparePlan now = plan();
        return now.tiles.size() == 2 && now.tiles[0].content.frame && now.tiles[1].content.frame;
    }));
    CHECK(plan().tiles[0].content.frame->settings.field.volumes == 24);
    CHECK(plan().tiles[1].content.frame->settings.field.volumes == 16);
    CHECK_THAT(plan().tiles[0].label, contains("24 volumes"));
    CHECK_THAT(plan().tiles[1].label, contains("16 volumes"));
    CHECK_THAT(name_of(model.comparison().now()), contains("24 volumes"));
    CHECK(plan().tiles[0].color != plan().tiles[1].color);
    // A run of its own, from nothing on.
    REQUIRE(bench.run_until(model, [&] { return run_of(16)->number != before; }));
    CHECK(model.comparison().accuracy().table().base);
    CHECK(model.frame()->settings.field.volumes == 24);
    model.comparison().set_turns(false);
    REQUIRE(
        bench.run_until(model, [&] { return !model.status().turns && !model.comparison().accuracy().table().base; }));
    CHECK(model.render().settings().field.volumes == 24);
}
