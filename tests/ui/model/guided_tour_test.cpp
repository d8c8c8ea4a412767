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
    REQUIRE(begin(bench, model));
    CHECK(model.scene().name() == "door");
    CHECK_FALSE(model.render().settings().next_event);
    CHECK_FALSE(model.render().paused());
    CHECK(model.link().turns() == TurnMethods{learning_method(), baseline_method()});
    CHECK(model.comparison().state().mode == CompareMode::Split);
    CHECK(model.window().panels.right);
}

TEST_CASE("Guided tour: a task has to be done for a while, and is then followed by the next step") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(begin(bench, model));
    const float split = model.comparison().state().split;
    model.comparison().set_split(0.25f);
    model.update(bench.clock += 0.1);
    model.comparison().set_split(split);  // back before the time has passed
    model.update(bench.clock += 2.0 * GuidedTour::kRestSeconds);
    CHECK(model.tour().step() == 0);
    model.comparison().set_split(0.25f);
    model.update(bench.clock += 0.1);
    CHECK(model.tour().step() == 0);
    model.update(bench.clock += GuidedTour::kRestSeconds);
    CHECK(model.tour().step() == 1);
}

TEST_CASE("Guided tour: left and continued, skipped to the end, and begun again") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(begin(bench, model));
    model.tour().skip_step(model);
    model.tour().leave();
    model.tour().skip_step(model);  // nothing while it is off
    CHECK(model.tour().step() == 1);
    REQUIRE(begin(bench, model));
    CHECK(state_text(model.tour()) == "2");
    for (std::size_t i = 1; i < tour_steps().size(); ++i) model.tour().skip_step(model);
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
