#include "ui/model/path_explorer.h"

#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"
#include "tests/ui/traced_floor.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Path explorer: hidden it traces nothing, shown it has the paths of the clicked pixel") {
    FileBench bench;
    bench.options.settings.method = MethodId::Reinforcement;
    bench.options.settings.next_event = true;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    model.paths().pick(kFloor);
    CHECK_FALSE(model.paths().is_tracing());
    CHECK_FALSE(model.paths().selected().has_value());

    model.paths().set_shown(true);
    model.paths().pick(kFloor);
    REQUIRE(bench.run_until(model, [&] { return is_traced(model); }));
    const diagnose::PixelPaths& paths = *model.paths().paths();
    CHECK(model.paths().x() == 32);
    CHECK(model.paths().y() == 41);
    CHECK(paths.plain.size() == 32);
    CHECK(paths.guided.size() == 32);
    CHECK(model.paths().guided_method() == MethodId::Reinforcement);
    CHECK(model.paths().lists_guided());
    // The brightest is selected.
    REQUIRE(model.paths().selected());
    for (const diagnose::PathRecord& path : model.paths().listed())
        CHECK(diagnose::path_light(path) <= diagnose::path_light(model.paths().listed()[*model.paths().selected()]));
    CHECK(model.paths().range().high > 0.0f);

    model.cancel();  // Esc
    CHECK_FALSE(model.paths().is_shown());
    CHECK(model.paths().paths() == nullptr);
}

TEST_CASE("Path explorer: other numbers are traced without another click") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    model.paths().set_shown(true);
    model.paths().pick(kFloor);
    REQUIRE(bench.run_until(model, [&] { return is_traced(model); }));
    CHECK(model.paths().paths()->guided.empty());  // nothing was learned
    CHECK_FALSE(model.paths().lists_guided());
    model.paths().options().count = 5;
    model.paths().options().choice = diagnose::PassChoice::Newest;
    REQUIRE(bench.run_until(model, [&] { return is_traced(model) && model.paths().paths()->passes.size() == 5; }));
    CHECK(model.paths().paths()->searched == 5);
}

TEST_CASE("Path explorer: lines are made once for each view of them, and not while hidden") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    model.paths().set_shown(true);
    CHECK(model.paths().pieces(*model.frame()).empty());
    CHECK(model.paths().times_made() == 0);
    model.paths().pick(kFloor);
    REQUIRE(bench.run_until(model, [&] { return is_traced(model); }));
    const std::size_t count = model.paths().pieces(*model.frame()).size();
    CHECK(count >= 32);
    for (int i = 0; i < 10; ++i) CHECK(model.paths().pieces(*model.frame()).size() == count);
    CHECK(model.paths().times_made() == 1);
    PublishedFrame moved = *model.frame();
    moved.snapshot.camera.eye.x += 0.5f;
    (void)model.paths().pieces(moved);
    CHECK(model.paths().times_made() == 2);
    moved.snapshot.camera.target.x += 0.5f;  // the same place: the same parts are hidden
    (void)model.paths().pieces(moved);
    CHECK(model.paths().times_made() == 2);
}

TEST_CASE("Path explorer: paths stay with a moved camera and go with their scene") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    model.paths().set_shown(true);
    model.paths().pick(kFloor);
    REQUIRE(bench.run_until(model, [&] { return is_traced(model); }));
    const std::uint64_t before = model.frame()->generation;
    model.render().restart();
    REQUIRE(bench.run_until(model, [&] { return model.frame()->generation > before; }));
    CHECK(model.paths().paths() != nullptr);
    model.scene().open("other");
    REQUIRE(bench.run_until(model, [&] { return model.paths().paths() == nullptr; }));
    CHECK(model.paths().is_shown());
}

TEST_CASE("Path explorer: a view without paths says so") {
    FileBench bench;
    bench.options.settings.view = View::Normal;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    model.paths().set_shown(true);
    model.paths().pick(kFloor);
    REQUIRE(bench.run_until(model, [&] { return told(model, "show 'beauty'"); }));
    CHECK_FALSE(model.paths().is_tracing());
}
