#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Viewer model: Esc closes the help, then interrupts precomputation, then deselects") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    bench.control->pass_microseconds = 0;
    bench.control->hold = true;
    model.render().set_method(MethodId::Precomputed);
    // The first slice is held: the state is visible after its release, during the next slice.
    REQUIRE(bench.run_until(model, [&] { return bench.control->inside.load(); }));
    bench.control->hold = false;
    bench.run_until(model, [&] {
        bench.control->hold = model.status().state == WorkerState::Precomputing;
        return model.status().state == WorkerState::Precomputing || model.status().passes > 0;
    });
    model.window().help = true;
    model.cancel();
    CHECK_FALSE(model.window().help);
    CHECK(model.render().settings().method == MethodId::Precomputed);
    if (model.status().state == WorkerState::Precomputing) {
        model.cancel();
        CHECK(model.render().settings().method == MethodId::Default);
    }
    bench.control->hold = false;
}

TEST_CASE("Viewer model: Esc shows hidden panels when nothing else is left to close") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    model.window().panels.shown = false;
    model.comparison().set_mode(CompareMode::Split);
    model.selection().select_volume(0);
    model.cancel();
    CHECK(model.selection().volume() == kNoVolume);
    CHECK(model.comparison().state().mode == CompareMode::Split);
    model.cancel();
    CHECK(model.comparison().state().mode == CompareMode::Off);
    CHECK_FALSE(model.window().panels.shown);
    model.cancel();
    CHECK(model.window().panels.shown);
    model.cancel();
    CHECK(model.window().panels.shown);
}

TEST_CASE("Viewer model: title and command line describe the picture") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    CHECK_THAT(model.title(), contains(" spp - Default, light samples off - CPU - small"));
    CHECK(model.files().pictures().command_line() == "pathlight render small");
    model.render().set_paused(true);
    REQUIRE(bench.run_until(model, [&] { return model.status().state == WorkerState::Paused; }));
    CHECK_THAT(model.title(), contains("paused: "));
}

TEST_CASE("Viewer model: a back end that cannot be made ends the viewer with its own error") {
    FileBench bench;
    bench.options.make_backend = [](const std::string&) -> std::unique_ptr<RenderBackend> {
        throw Error(ErrorKind::Unavailable, "no such device");
    };
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    CHECK_THROWS_AS(bench.run_until(model, [] { return false; }), Error);
}
