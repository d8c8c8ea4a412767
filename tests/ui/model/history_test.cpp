// Undo and redo: what is noted, under which name, what is one change, and what comes back.
#include "ui/model/history.h"

#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"
#include "ui/model/viewer_model.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

struct HistoryBench : FileBench {
    ViewerModel model;

    HistoryBench() : model(options, small_scene(), options.settings, 0.0) { model.update(clock); }
    /// A frame of the window, `seconds` after the last one.
    void frame(double seconds = 1.0) { model.update(clock += seconds); }
    std::string undone_next() const { return model.history().undone_next(); }
    std::string redone_next() const { return model.history().redone_next(); }
};

}  // namespace

TEST_CASE("History: a setting is undone and done again, under its name") {
    HistoryBench bench;
    CHECK(bench.undone_next().empty());
    bench.model.render().set_next_event(true);
    bench.frame();
    CHECK(bench.undone_next() == "light samples on");
    bench.model.render().set_method(MethodId::Reinforcement);
    bench.frame();
    CHECK(bench.undone_next() == "method Reinforcement");
    bench.model.history().undo(bench.model);
    bench.frame();
    CHECK(bench.model.render().method() == MethodId::Default);
    CHECK(bench.model.render().settings().next_event);
    CHECK(bench.undone_next() == "light samples on");
    CHECK(bench.redone_next() == "method Reinforcement");
    bench.model.history().undo(bench.model);
    bench.frame();
    CHECK_FALSE(bench.model.render().settings().next_event);
    CHECK(bench.undone_next().empty());
    bench.model.history().undo(bench.model);
    CHECK(told(bench.model, "nothing to undo"));
    bench.model.history().redo(bench.model);
    bench.model.history().redo(bench.model);
    bench.frame();
    CHECK(bench.model.render().method() == MethodId::Reinforcement);
    CHECK(bench.redone_next().empty());
    bench.model.history().redo(bench.model);
    CHECK(told(bench.model, "nothing to redo"));
}

TEST_CASE("History: a change after undo drops what could be done again") {
    HistoryBench bench;
    bench.model.render().set_max_depth(9);
    bench.frame();
    bench.model.history().undo(bench.model);
    bench.frame();
    bench.model.render().set_seed(7);
    bench.frame();
    CHECK(bench.undone_next() == "seed 7");
    CHECK(bench.redone_next().empty());
}

TEST_CASE("History: materials, exposure and camera come back to the bit") {
    HistoryBench bench;
    const MaterialDescription before = bench.model.scene().materials().now()[0];
    MaterialDescription after = before;
    after.albedo = glm::vec3(0.2f);
    bench.model.scene().set_material(0, after);
    bench.frame();
    const CameraDescription camera = bench.model.camera().camera();
    bench.model.camera().look({30.0f, 10.0f});
    bench.frame();
    CHECK(bench.undone_next() == "camera");
    const float exposure = bench.model.display().settings().exposure_ev;
    bench.model.display().set_exposure(exposure + 2.0f);
    bench.frame();
    for (int i = 0; i < 3; ++i) bench.model.history().undo(bench.model);
    bench.frame();
    CHECK(bench.model.display().settings().exposure_ev == exposure);
    CHECK(bench.model.camera().camera().target == camera.target);
    CHECK(bench.model.scene().materials().now()[0] == before);
    CHECK(bench.undone_next().empty());
    bench.model.history().redo(bench.model);
    CHECK(bench.model.scene().materials().now()[0] == after);
}

TEST_CASE("History: a drag is one change, a flight is one, and a drag that ends where it began is none") {
    HistoryBench bench;
    const float exposure = bench.model.display().settings().exposure_ev;
    const auto drag = [&](float to) {
        bench.model.window().is_dragging = true;
        for (const float share : {0.25f, 0.5f, 1.0f}) {
            bench.model.display().set_exposure(exposure + share * (to - exposure));
            bench.frame(2.0);  // the pointer rests in between
        }
        bench.model.window().is_dragging = false;
        bench.frame();
    };
    drag(exposure + 1.0f);
    drag(exposure + 3.0f);
    bench.model.history().undo(bench.model);
    CHECK(bench.model.display().settings().exposure_ev == exposure + 1.0f);
    bench.model.history().undo(bench.model);
    CHECK(bench.model.display().settings().exposure_ev == exposure);
    bench.frame();
    CHECK(bench.undone_next().empty());

    const CameraDescription camera = bench.model.camera().camera();
    for (int i = 0; i < 20; ++i) {
        bench.model.camera().fly({.forward = 1.0f}, 0.02);
        bench.frame(0.02);
    }
    bench.model.history().undo(bench.model);
    CHECK(bench.model.camera().camera().eye == camera.eye);
    bench.frame();
    CHECK(bench.undone_next().empty());

    bench.frame();
    bench.model.display().set_exposure(exposure + 1.0f);
    bench.frame(0.1);
    bench.model.display().set_exposure(exposure);
    bench.frame(0.1);
    CHECK(bench.undone_next().empty());
}

TEST_CASE("History: an exposure that follows the picture is not noted, and another scene begins anew") {
    HistoryBench bench;
    bench.model.exposure().set_on(true);
    bench.model.display().set_exposure(1.5f);
    bench.model.history().update(bench.model, bench.clock += 1.0, false);
    CHECK(bench.undone_next().empty());
    bench.model.render().set_seed(3);
    bench.model.exposure().set_on(false);
    bench.frame();
    CHECK(bench.undone_next() == "seed 3");
    bench.model.scene().open("other");
    REQUIRE(bench.run_until(bench.model, [&] { return bench.model.scene().name() == "other"; }));
    bench.frame();
    CHECK(bench.undone_next().empty());
}
