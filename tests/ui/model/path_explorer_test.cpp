// The noise of the clicked pixel: traced only while a panel shows it.
#include "ui/model/path_explorer.h"

#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"
#include "tests/ui/traced_floor.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Noise tracing: works while it is shown, rests while it is hidden, and ends with the paths") {
    FileBench bench;
    bench.options.settings.method = MethodId::Reinforcement;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    NoiseTracing& noise = model.paths().noise();
    noise.show();
    model.paths().set_shown(true);
    model.paths().pick(kFloor);
    REQUIRE(bench.run_until(model, [&] { return is_traced(model); }));
    CHECK(noise.noise() == nullptr);
    CHECK_FALSE(noise.is_working());
    CHECK(noise.seconds() == 0.0);

    REQUIRE(bench.run_until(model, [&] {
        noise.show();
        return noise.noise() != nullptr;
    }));
    CHECK(noise.failure().empty());
    CHECK(noise.noise()->pixel == model.paths().paths()->pixel);
    CHECK(noise.noise()->plain.paths >= kJackknifeGroups);
    CHECK(noise.noise()->guided.has_value());
    CHECK(noise.noise()->guided_method == MethodId::Reinforcement);

    // Hidden, it rests with its result; shown again, it goes on.
    REQUIRE(bench.run_until(model, [&] { return !noise.is_working(); }));
    const std::uint64_t paths = noise.noise()->plain.paths;
    const double seconds = noise.seconds();
    for (int i = 0; i < 5; ++i) model.update(0.0);
    CHECK_FALSE(noise.is_working());
    CHECK(noise.seconds() == seconds);
    if (paths < NoiseTracing::kMostPaths)
        REQUIRE(bench.run_until(model, [&] {
            noise.show();
            return noise.noise()->plain.paths > paths;
        }));

    // Another pixel starts over; Esc ends all.
    model.paths().pick({0.3f, 0.65f});
    REQUIRE(bench.run_until(model, [&] { return noise.noise() == nullptr; }));
    model.cancel();
    CHECK_FALSE(model.paths().is_shown());
    model.update(0.0);
    CHECK_FALSE(noise.is_working());
    CHECK(noise.noise() == nullptr);
}

TEST_CASE("Noise tracing: it ends at the largest number of paths") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    model.paths().set_shown(true);
    model.paths().pick(kFloor);
    REQUIRE(bench.run_until(model, [&] {
        model.paths().noise().show();
        const diagnose::PixelNoise* const noise = model.paths().noise().noise();
        return noise != nullptr && noise->plain.paths >= NoiseTracing::kMostPaths;
    }));
    CHECK(model.paths().noise().noise()->plain.paths == NoiseTracing::kMostPaths);
    CHECK_FALSE(model.paths().noise().noise()->guided);  // nothing was learned
    model.paths().noise().show();
    model.update(0.0);
    CHECK_FALSE(model.paths().noise().is_working());
}

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
