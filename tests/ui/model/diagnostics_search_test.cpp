// The search for invalid samples: counted, found in the background, marked until the picture changes.
#include "tests/support/catch.hpp"
#include "tests/ui/model_bench.h"
#include "ui/script/script_values.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

constexpr int kBad = 37;

/// A viewer of a picture with one pixel that has only invalid samples.
struct DiagnosticsBench : ModelBench {
    DiagnosticsBench() : ModelBench(16) {
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
    "Diagnostics search: invalid samples are counted, their pixels found, and marked until the picture changes") {
    DiagnosticsBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.is_done(model));
    CHECK(diagnose::counted_diagnostics(model.frame()->snapshot) == diagnose::DiagnosticCounts{4, 0, 0, 0});
    CHECK(script_value(model, "diagnostics") == "not searched");

    model.diagnostics().toggle();
    CHECK(model.busy());
    REQUIRE(bench.run_until(model, [&] { return model.diagnostics().map() != nullptr; }));
    const auto map = model.diagnostics().map();
    CHECK(map->is_complete);
    CHECK(map->pixels[kBad] == diagnose::DiagnosticsMap::Pixel{4, 0, 0, 0});
    CHECK(map->pixel_count(diagnose::DiagnosticKind::InvalidSample) == 1);
    CHECK(script_value(model, "diagnostics") == "4 invalid in 1 pixel");
    CHECK(told(model, "4 invalid in 1 pixel"));
    CHECK_FALSE(model.busy());

    model.diagnostics().toggle();
    CHECK(model.diagnostics().map() == nullptr);
    model.diagnostics().toggle();
    REQUIRE(bench.run_until(model, [&] { return model.diagnostics().map() != nullptr; }));
    model.render().set_seed(2);
    REQUIRE(bench.run_until(model, [&] { return model.diagnostics().map() == nullptr; }));
    REQUIRE(bench.is_done(model));
    CHECK(model.diagnostics().map() == nullptr);
}

TEST_CASE("Diagnostics search: Esc removes the marks, further passes do not") {
    DiagnosticsBench bench;
    bench.options.limits.spp = 0;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.frame() != nullptr; }));
    model.diagnostics().toggle();
    REQUIRE(bench.run_until(model, [&] { return model.diagnostics().map() != nullptr; }));
    const std::uint32_t passes = model.frame()->snapshot.passes;
    REQUIRE(bench.run_until(model, [&] { return model.frame()->snapshot.passes > passes + 2; }));
    CHECK(model.diagnostics().map() != nullptr);
    model.cancel();
    CHECK(model.diagnostics().map() == nullptr);
}

TEST_CASE("Diagnostics search: a view without paths is reported, and rendering continues") {
    DiagnosticsBench bench;
    bench.options.limits.spp = 0;
    bench.options.settings.view = View::Normal;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.frame() != nullptr; }));
    model.diagnostics().toggle();
    REQUIRE(bench.run_until(model, [&] { return told(model, "view 'normal' has no paths") && !model.busy(); }));
    CHECK(model.diagnostics().map() == nullptr);
    REQUIRE(bench.run_until(model, [&] { return model.status().state == WorkerState::Rendering; }));
}

TEST_CASE("Diagnostics search: a lost device ends the search with a message") {
    DiagnosticsBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.is_done(model));
    bench.devices.cpu->lost = true;
    model.diagnostics().toggle();
    // Rendering meets the lost device, too, and may tell it first.
    REQUIRE(bench.run_until(model, [&] { return told(model, "the device is lost") && !model.busy(); }));
    CHECK(model.diagnostics().map() == nullptr);
}

TEST_CASE("Diagnostics search: a picture of valid samples has no marks") {
    DiagnosticsBench bench;
    bench.devices.cpu->bad_pixel = -1;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.is_done(model));
    model.diagnostics().toggle();
    REQUIRE(bench.run_until(model, [&] { return model.diagnostics().map() != nullptr; }));
    CHECK(script_value(model, "diagnostics") == "nothing wrong found");
}
