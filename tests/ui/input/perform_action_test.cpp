// Every action of the key table has an effect.
#include "tests/support/catch.hpp"
#include "tests/ui/model_bench.h"
#include "ui/input/perform_action.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Perform action: every action but the held keys has an effect, each method its own") {
    ModelBench bench(16);
    bench.options.load_scene = [](const SceneRequest&) { return small_scene(); };
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    for (const Action& action : all_actions()) {
        INFO(action.text);
        CHECK(perform(model, action) == !action.is_held);
        if (action.method) CHECK(model.render().method() == *action.method);
    }
    CHECK(model.window().requests.quit);
    CHECK(model.display().cells());
}

TEST_CASE("Perform action: menus know what is on") {
    ModelBench bench(16);
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    for (const ActionId id : {ActionId::NextEvent, ActionId::Pause, ActionId::FollowExposure, ActionId::Denoise,
                              ActionId::Cells, ActionId::LobesOrDome, ActionId::Hemisphere, ActionId::Flowers,
                              ActionId::TracePaths, ActionId::ShowGain, ActionId::Accuracy, ActionId::Turns}) {
        INFO(info_of(id).text);
        const bool before = is_on(model, info_of(id));
        perform(model, id);
        CHECK(is_on(model, info_of(id)) != before);
    }
    for (const Action& action : all_actions())
        if (action.method) CHECK(is_on(model, action) == (*action.method == model.render().method()));
}
