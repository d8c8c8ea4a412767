#include "ui/model/field_flowers.h"

#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Learning time: key frames are kept on request, shown, played back and forth, and given up") {
    FileBench bench;
    bench.options.settings.method = MethodId::Reinforcement;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    LearningTime& time = model.time();
    CHECK(time.history()->frames.empty());
    time.show(0);
    CHECK(time.frame() == nullptr);  // there is none

    time.set_keeps(true);
    REQUIRE(bench.run_until(model, [&] { return time.history()->frames.size() >= 3; }));
    model.render().set_paused(true);
    REQUIRE(bench.run_until(model, [&] { return model.status().state == WorkerState::Paused; }));
    const auto last = time.history()->frames.size();
    time.show(1);
    REQUIRE(time.frame() != nullptr);
    CHECK(time.frame()->passes() == time.history()->frames[1]->passes());
    const auto then = time.inspection(0);
    REQUIRE(then);
    CHECK(then->side > 0);
    CHECK(time.inspection(0) == then);  // read once
    CHECK(time.inspection(100000) == nullptr);
    CHECK(time.inspection(kNoVolume) == nullptr);

    // On to the present, then back to the beginning.
    time.set_playing(true);
    REQUIRE(bench.run_until(model, [&] { return !time.shown().has_value(); }));
    REQUIRE(bench.run_until(model, [&] { return time.shown() == std::size_t{0}; }));
    time.set_playing(false);
    CHECK(time.history()->frames.size() == last);

    time.set_keeps(false);
    CHECK_FALSE(time.shown().has_value());
    REQUIRE(bench.run_until(model, [&] { return time.history()->frames.empty(); }));
}

TEST_CASE("Learning time: the shown frame stays while others are taken") {
    FileBench bench;
    bench.options.settings.method = MethodId::Reinforcement;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    model.time().set_keeps(true);
    REQUIRE(bench.run_until(model, [&] { return model.time().history()->frames.size() >= 2; }));
    model.time().show(0);
    const std::uint64_t passes = model.time().frame()->passes();
    const std::size_t frames = model.time().history()->frames.size();
    REQUIRE(bench.run_until(model, [&] { return model.time().history()->frames.size() > frames + 1; }));
    REQUIRE(model.time().frame() != nullptr);
    CHECK(model.time().frame()->passes() == passes);
}

TEST_CASE("Flowers: hidden nothing is taken or made, and shown triangles are made once for a camera") {
    FileBench bench;
    bench.options.settings.method = MethodId::Reinforcement;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    FieldFlowers& flowers = model.flowers();
    CHECK(flowers.flowers() == nullptr);
    CHECK(model.time().history()->frames.empty());

    flowers.set_shown(true);
    model.render().set_paused(true);
    REQUIRE(bench.run_until(
        model, [&] { return flowers.flowers() != nullptr && model.status().state == WorkerState::Paused; }));
    for (int i = 0; i < 20; ++i) model.update(bench.clock += 1.0 / 60.0);
    const std::size_t volumes = model.time().history()->frames.back()->volumes();
    CHECK(flowers.flowers()->flowers.size() == volumes);
    const Rect image{0.0f, 0.0f, 300.0f, 300.0f};
    const std::uint64_t before = flowers.times_made();
    for (int i = 0; i < 10; ++i) (void)flowers.mesh(*model.frame(), image);
    CHECK(flowers.times_made() == before + 1);
    CHECK(flowers.counts().triangles == flowers.mesh(*model.frame(), image)->triangles());
    PublishedFrame moved = *model.frame();
    moved.snapshot.camera.eye.x += 0.1f;
    (void)flowers.mesh(moved, image);
    CHECK(flowers.times_made() == before + 2);

    // The triangles of another field come with it.
    flowers.set_step(4);
    REQUIRE(bench.run_until(model, [&] { return flowers.flowers()->flowers.size() == (volumes + 3) / 4; }));
    CHECK(flowers.times_made() == before + 3);
    (void)flowers.mesh(moved, image);
    CHECK(flowers.times_made() == before + 3);
    CHECK(flowers.counts().drawn <= (volumes + 3) / 4);

    flowers.set_shown(false);
    CHECK(flowers.flowers() == nullptr);
    REQUIRE(bench.run_until(model, [&] { return model.time().history()->frames.empty(); }));
}
