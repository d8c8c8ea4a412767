// The guided tour: begins with known settings, goes on when a task has been done for a while, is left and continued.
#include "ui/model/guided_tour.h"

#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

using Phase = GuidedTour::Phase;

bool begin(FileBench& bench, ViewerModel& model) {
    model.tour().begin(model);
    return bench.run_until(model, [&] { return model.tour().phase() == Phase::Running; });
}

}  // namespace

TEST_CASE("Guided tour: offered until it is answered") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    GuidedTour& tour = model.tour();
    tour.offer();
    CHECK(tour.phase() == Phase::Offered);
    CHECK_FALSE(tour.is_answered());
    model.cancel();
    CHECK(tour.phase() == Phase::Off);
    CHECK(tour.is_answered());
    tour.offer();
    CHECK(tour.phase() == Phase::Off);
    tour.remember(0, false);
    tour.offer();
    CHECK(tour.phase() == Phase::Offered);
    REQUIRE(begin(bench, model));
    CHECK(tour.is_answered());
}

TEST_CASE("Guided tour: two methods without light samples in turns, split, everything visible") {
    FileBench bench;
    bench.options.settings.next_event = true;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    model.window().panels.right = false;
    model.render().set_paused(true);
    model.display().set_exposure(1.25f);
    REQUIRE(begin(bench, model));
    CHECK(model.display().settings().exposure_ev == 0.0f);
    CHECK(model.scene().name() == "door");
    CHECK_FALSE(model.render().settings().next_event);
    CHECK_FALSE(model.render().paused());
    REQUIRE(model.link().turns());
    CHECK(model.link().turns()->methods == std::array{learning_method(), baseline_method()});
    CHECK(model.comparison().state().mode == CompareMode::Split);
    CHECK(model.window().panels.right);
}

TEST_CASE("Guided tour: a task has to be done for a while, and is then followed by what was seen") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(begin(bench, model));
    const float split = model.comparison().state().split;
    model.comparison().set_split(0.25f);
    model.update(bench.clock += 0.1);
    model.comparison().set_split(split);  // back before the time has passed
    model.update(bench.clock += 2.0 * GuidedTour::kRestSeconds);
    CHECK_FALSE(model.tour().is_seen());
    model.comparison().set_split(0.25f);
    model.update(bench.clock += 0.1);
    CHECK_FALSE(model.tour().is_seen());
    model.update(bench.clock += GuidedTour::kRestSeconds);
    CHECK(model.tour().is_seen());
    CHECK(model.tour().step() == 0);  // until the user goes on
    for (int step = 0; step < static_cast<int>(tour_steps().size()); ++step)
        CHECK_FALSE(seen_text(model, step).empty());
    model.tour().next_step(model);
    CHECK(model.tour().step() == 1);
    CHECK_FALSE(model.tour().is_seen());
    model.tour().last_step(model);
    model.tour().last_step(model);  // there is none before the first
    CHECK(model.tour().step() == 0);
}

TEST_CASE("Guided tour: the camera of the step about another view comes back with the next one") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(begin(bench, model));
    for (int step = 0; step < 4; ++step) model.tour().next_step(model);
    const Vec3f eye = model.camera().camera().eye;
    model.camera().fly({.right = 1.0f}, 0.1);
    CHECK(model.camera().camera().eye != eye);
    model.tour().next_step(model);
    CHECK(model.camera().camera().eye == eye);
}

TEST_CASE("Guided tour: the last step is done by both gains, and not by the key for light samples") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(begin(bench, model));
    for (std::size_t i = 1; i < tour_steps().size(); ++i) model.tour().next_step(model);
    model.render().set_next_event(true);
    for (int i = 0; i < 3; ++i) model.update(bench.clock += GuidedTour::kRestSeconds);
    CHECK_FALSE(model.tour().is_seen());
    CHECK_THAT(seen_text(model, model.tour().step()), contains("not measured"));
}

TEST_CASE("Guided tour: left and continued, gone through to the end, and begun again") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(begin(bench, model));
    model.tour().next_step(model);
    model.tour().leave();
    model.tour().next_step(model);  // nothing while it is off
    CHECK(model.tour().step() == 1);
    REQUIRE(begin(bench, model));
    CHECK(state_text(model.tour()) == "2");
    for (std::size_t i = 1; i < tour_steps().size(); ++i) model.tour().next_step(model);
    CHECK(model.tour().phase() == Phase::Finished);
    model.tour().leave();
    REQUIRE(begin(bench, model));
    CHECK(model.tour().step() == 0);
}

TEST_CASE("Guided tour: ends where its scene cannot be opened, and with another scene") {
    FileBench bench;
    const auto load = bench.options.load_scene;
    bench.options.load_scene = [load](const SceneRequest& request) {
        return load({request.name == GuidedTour::kScene ? "broken.obj" : request.name});
    };
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    model.tour().begin(model);
    REQUIRE(bench.run_until(model, [&] { return model.tour().phase() == Phase::Off; }));
    CHECK(told(model, "broken.obj:7"));

    FileBench other;
    ViewerModel second(other.options, small_scene(), other.options.settings, 0.0);
    REQUIRE(begin(other, second));
    second.scene().open("other");
    REQUIRE(other.run_until(second, [&] { return second.tour().phase() == Phase::Off; }));
}
