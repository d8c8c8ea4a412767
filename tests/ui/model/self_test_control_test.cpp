// The self test in the window: rendering rests while it runs, and Esc ends it.
#include "tests/support/catch.hpp"
#include "tests/ui/model_bench.h"
#include "ui/script/script_values.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Self test: rendering rests while it runs, and Esc ends it") {
    ModelBench bench(16);
    bench.options.backends = {{"cpu", "", ""}, {"cuda", "", "there is none"}};
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.frame() != nullptr; }));
    model.self_test().start();
    CHECK(model.self_test().is_shown());
    CHECK(script_value(model, "selftest") == "running");
    CHECK(model.busy());
    REQUIRE(bench.run_until(model, [&] {
        return !model.self_test().run().checks().empty() && model.status().state == WorkerState::Paused;
    }));
    CHECK(model.self_test().run().checks()[0].backend == "cpu");
    model.cancel();
    REQUIRE(bench.run_until(model, [&] { return !model.self_test().run().is_running(); }));
    // The fake back end paints one value, which no closed form matches.
    CHECK(model.self_test().run().outcome() == SelfTestRun::Outcome::Failed);
    CHECK(told(model, "self test: "));
    REQUIRE(bench.run_until(model, [&] { return model.status().state == WorkerState::Rendering; }));
    model.cancel();
    CHECK_FALSE(model.self_test().is_shown());
}

TEST_CASE("Self test: closing the viewer ends a self test and a search") {
    ModelBench bench(16);
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    model.self_test().start();
    model.diagnostics().toggle();
    model.update(0.0);
}
