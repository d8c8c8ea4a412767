// Loading on the helper thread: only the newest request waits, a failure is told, and knobs reach the picture.
#include <atomic>
#include <mutex>

#include "core/base/error.h"
#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

/// A scene with one knob, which moves the camera's home; loads can be held.
struct KnobBench : ModelBench {
    std::atomic<bool> hold{false};
    std::atomic<bool> loading{false};
    std::mutex mutex;
    std::vector<SceneRequest> requests;  ///< in the order of their loads

    KnobBench() : ModelBench(16) {
        options.load_scene = [this](const SceneRequest& request) { return load(request); };
    }
    static std::shared_ptr<SceneDescription> scene(float value = 2.0f) {
        auto made = std::make_shared<SceneDescription>(*small_scene());
        made->knobs = {
            {.name = "gap", .does = "width", .low = 1.0f, .high = 5.0f, .default_value = 2.0f, .value = value}};
        made->positions[0].y += 0.01f * (value - 2.0f);
        return made;
    }
    std::shared_ptr<const SceneDescription> load(const SceneRequest& request) {
        {
            const std::lock_guard lock(mutex);
            requests.push_back(request);
        }
        loading = true;
        while (hold) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        loading = false;
        if (request.name == "broken.obj") throw Error(ErrorKind::Input, "broken.obj:7: expected a number");
        const float value = request.knobs.empty() ? 2.0f : request.knobs.back().second;
        if (value > 5.0f) throw Error(ErrorKind::Usage, "gap=9: expected 1 to 5");
        return scene(value);
    }
    std::vector<SceneRequest> loaded() {
        const std::lock_guard lock(mutex);
        return requests;
    }
    bool shows(ViewerModel& model, float value) {
        return run_until(model,
                         [&] { return has_frame(model) && model.frame()->description->knobs.at(0).value == value; });
    }
};

SceneRequest small_with_gap(float value) { return {"small", {{"gap", value}}}; }

}  // namespace

TEST_CASE("Scene loader: a knob loads the scene again, camera and edited materials stay") {
    KnobBench bench;
    ViewerModel model(bench.options, KnobBench::scene(), bench.options.settings, 0.0);
    REQUIRE(bench.shows(model, 2.0f));
    CHECK(model.scene().shown() == SceneRequest{"small"});
    model.camera().fly({.right = 1.0f}, 0.1);
    MaterialDescription gray = model.scene().materials().now()[0];
    gray.albedo = glm::vec3{0.25f};
    model.scene().set_material(0, gray);
    const float eye = model.camera().camera().eye.x;

    model.scene().set_knob(0, 3.5f);
    CHECK(model.scene().knobs()[0].value == 3.5f);
    REQUIRE(bench.shows(model, 3.5f));
    CHECK(model.camera().camera().eye.x == eye);
    CHECK(model.frame()->snapshot.camera.eye.x == eye);
    CHECK(bench.run_until(model, [&] { return model.frame()->description->materials[0] == gray; }));
    CHECK(model.scene().shown() == small_with_gap(3.5f));
    CHECK(model.files().pictures().picture().scene == small_with_gap(3.5f));
    CHECK(model.files().pictures().picture().description->knobs[0].value == 3.5f);

    model.scene().reload();
    REQUIRE(bench.run_until(model, [&] { return model.scene().materials().edited_names().empty(); }));
    CHECK(model.scene().knobs()[0].value == 3.5f);
    model.scene().reset_knobs();
    CHECK(bench.shows(model, 2.0f));
    CHECK(bench.loaded().back() == SceneRequest{"small"});
}

TEST_CASE("Scene loader: of the values during a load only the newest is loaded") {
    KnobBench bench;
    ViewerModel model(bench.options, KnobBench::scene(), bench.options.settings, 0.0);
    bench.hold = true;
    model.scene().set_knob(0, 2.5f);
    REQUIRE(eventually([&] { return bench.loading.load(); }));
    for (const float value : {2.75f, 3.0f, 4.0f}) model.scene().set_knob(0, value);
    bench.hold = false;
    REQUIRE(bench.shows(model, 4.0f));
    CHECK(bench.loaded() == std::vector{small_with_gap(2.5f), small_with_gap(4.0f)});
    CHECK(model.scene().knobs()[0].value == 4.0f);
}

TEST_CASE("Scene loader: a refused value leaves the old one, with the reason") {
    KnobBench bench;
    ViewerModel model(bench.options, KnobBench::scene(), bench.options.settings, 0.0);
    model.scene().set_knob(0, 3.0f);
    REQUIRE(bench.shows(model, 3.0f));
    model.scene().set_knob(0, 9.0f);
    REQUIRE(bench.run_until(model, [&] { return told(model, "gap=9: expected 1 to 5"); }));
    CHECK(model.scene().knobs()[0].value == 3.0f);
    CHECK(model.scene().shown() == small_with_gap(3.0f));
    model.scene().set_knob(1, 3.0f);  // there is none
    CHECK(model.scene().shown() == small_with_gap(3.0f));
}

TEST_CASE("Scene loader: another scene replaces waiting values, and knobs rest until it is there") {
    KnobBench bench;
    ViewerModel model(bench.options, KnobBench::scene(), bench.options.settings, 0.0);
    bench.hold = true;
    model.scene().set_knob(0, 2.5f);
    model.scene().set_knob(0, 3.0f);
    model.scene().open("other");
    model.scene().set_knob(0, 4.0f);
    model.scene().reload();
    bench.hold = false;
    REQUIRE(bench.run_until(model, [&] { return model.scene().name() == "other"; }));
    CHECK(model.scene().knobs()[0].value == 2.0f);
    CHECK(bench.loaded() == std::vector{small_with_gap(2.5f), SceneRequest{"other"}});
    model.scene().open("broken.obj");
    REQUIRE(bench.run_until(model, [&] { return told(model, "broken.obj:7"); }));
    CHECK(model.scene().name() == "other");
    model.scene().set_knob(0, 4.0f);
    CHECK(bench.shows(model, 4.0f));
}
