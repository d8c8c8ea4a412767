// Diagnostics in the window: counted, located in the background, shown while the picture stands; the self test.
#include <algorithm>

#include "tests/catch.hpp"
#include "tests/ui/model_bench.h"
#include "ui/script_values.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr int kSide = 16;
constexpr int kBad = 37;

bool told(const ViewerModel& model, const std::string& part) {
    return std::any_of(model.log().begin(), model.log().end(),
                       [&](const LogLine& line) { return line.text.find(part) != std::string::npos; });
}

/// A viewer of a picture in which one pixel has only invalid samples.
struct DiagnosticsBench : ModelBench {
    DiagnosticsBench() : ModelBench(kSide) {
        devices.cpu->bad_pixel = kBad;
        options.limits.spp = 4;
    }
    bool is_done(ViewerModel& model) {
        return run_until(model, [&] {
            return model.frame() != nullptr && model.frame()->snapshot.passes == 4 &&
                   model.status().state == WorkerState::Done;
        });
    }
};

}  // namespace

TEST_CASE(
    "Window: invalid samples are counted in the frame, found where they were, and marked until the picture changes") {
    DiagnosticsBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.is_done(model));
    CHECK(counted_diagnostics(model.frame()->snapshot) == DiagnosticCounts{4, 0, 0, 0});
    CHECK(script_value(model, "diagnostics") == "not looked for");

    model.toggle_diagnostics();
    CHECK(model.busy());
    REQUIRE(bench.run_until(model, [&] { return model.diagnostics() != nullptr; }));
    const auto map = model.diagnostics();
    CHECK(map->is_complete);
    CHECK(map->pixels[kBad] == DiagnosticsMap::Pixel{4, 0, 0, 0});
    CHECK(map->pixel_count(DiagnosticKind::InvalidSample) == 1);
    CHECK(script_value(model, "diagnostics") == "4 invalid in 1 pixel");
    CHECK(told(model, "4 invalid in 1 pixel"));
    CHECK_FALSE(model.busy());

    model.toggle_diagnostics();
    CHECK(model.diagnostics() == nullptr);
    model.toggle_diagnostics();
    REQUIRE(bench.run_until(model, [&] { return model.diagnostics() != nullptr; }));
    model.set_seed(2);
    REQUIRE(bench.run_until(model, [&] { return model.diagnostics() == nullptr; }));
    REQUIRE(bench.is_done(model));
    CHECK(model.diagnostics() == nullptr);
}

TEST_CASE("Window: Esc ends the marks, and a picture that goes on does not") {
    DiagnosticsBench bench;
    bench.options.limits.spp = 0;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.frame() != nullptr; }));
    model.toggle_diagnostics();
    REQUIRE(bench.run_until(model, [&] { return model.diagnostics() != nullptr; }));
    const std::uint32_t passes = model.frame()->snapshot.passes;
    REQUIRE(bench.run_until(model, [&] { return model.frame()->snapshot.passes > passes + 2; }));
    CHECK(model.diagnostics() != nullptr);
    model.cancel();
    CHECK(model.diagnostics() == nullptr);
}

TEST_CASE("Window: a view without paths says so, and rendering goes on") {
    DiagnosticsBench bench;
    bench.options.limits.spp = 0;
    bench.options.settings.view = View::Normal;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.frame() != nullptr; }));
    model.toggle_diagnostics();
    REQUIRE(bench.run_until(model, [&] { return told(model, "view 'normal' has no paths"); }));
    CHECK_FALSE(model.busy());
    CHECK(model.diagnostics() == nullptr);
    REQUIRE(bench.run_until(model, [&] { return model.status().state == WorkerState::Rendering; }));
}

TEST_CASE("Window: a device that is lost while diagnostics is looked for is told, and holds nothing up") {
    DiagnosticsBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.is_done(model));
    bench.devices.cpu->lost = true;
    model.toggle_diagnostics();
    REQUIRE(bench.run_until(model, [&] { return told(model, "the device is lost"); }));
    CHECK_FALSE(model.busy());
    CHECK(model.diagnostics() == nullptr);
}

TEST_CASE("Window: nothing is found where nothing went wrong") {
    DiagnosticsBench bench;
    bench.devices.cpu->bad_pixel = -1;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.is_done(model));
    model.toggle_diagnostics();
    REQUIRE(bench.run_until(model, [&] { return model.diagnostics() != nullptr; }));
    CHECK(script_value(model, "diagnostics") == "nothing wrong found");
}

TEST_CASE("Window: rendering rests during the self test, and Esc ends it") {
    ModelBench bench(kSide);
    bench.options.backends = {{"cpu", "", ""}, {"cuda", "", "there is none"}};
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.frame() != nullptr; }));
    model.start_self_test();
    CHECK(model.window().self_test);
    CHECK(script_value(model, "selftest") == "running");
    CHECK(model.busy());
    REQUIRE(bench.run_until(
        model, [&] { return !model.self_test().checks().empty() && model.status().state == WorkerState::Paused; }));
    CHECK(model.self_test().checks()[0].backend == "cpu");
    model.cancel();
    REQUIRE(bench.run_until(model, [&] { return !model.self_test().is_running(); }));
    // The fake back end paints one value, which no closed form has.
    CHECK(model.self_test().outcome() == SelfTestRun::Outcome::Failed);
    CHECK(told(model, "self test: "));
    REQUIRE(bench.run_until(model, [&] { return model.status().state == WorkerState::Rendering; }));
    model.cancel();
    CHECK_FALSE(model.window().self_test);
}

TEST_CASE("Window: closing it ends a self test and a search") {
    ModelBench bench(kSide);
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    model.start_self_test();
    model.toggle_diagnostics();
    model.update(0.0);
}
