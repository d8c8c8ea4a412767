#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"
#include "ui/model/window_memory.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

/// Nothing in it is as at a first start.
WindowMemory changed_memory() {
    WindowMemory memory;
    memory.place = WindowPlace{-20, 30, 1000, 700, true};
    memory.ui_scale = 1.25f;
    memory.layout = WindowLayout::Research;
    memory.panels = {.shown = true,
                     .settings = false,
                     .right = false,
                     .tabs = false,
                     .accuracy = false,
                     .settings_em = 20.5f,
                     .right_em = 30.25f,
                     .accuracy_share = 0.5f};
    memory.hemisphere = false;
    memory.tint_opacity = 0.75f;
    memory.coarser_in_motion = false;
    memory.preview_in_motion = false;
    memory.plot = {ErrorMetric::Smape, CostAxis::Samples};
    memory.recent = {"cornell", "a \"b\"/sc\u00e4ne.obj"};
    memory.tour_step = 3;
    memory.is_tour_answered = true;
    return memory;
}

Json json_of(const WindowMemory& memory) {
    Json document = Json::object();
    write_memory(memory, document);
    return document;
}

}  // namespace

TEST_CASE("Window memory: what is written is read") {
    for (const WindowMemory& memory : {WindowMemory{}, changed_memory()}) {
        const Json document = Json::parse(json_of(memory).dump());
        CHECK(memory_in(document, {}, "file") == memory);
        CHECK(memory_in(document, changed_memory(), "file").place == memory.place);
    }
}

TEST_CASE("Window memory: members that are missing are those of a first start, unknown ones stay in the file") {
    CHECK(memory_in(Json::object(), {}, "file") == WindowMemory{});
    Json document = Json::parse(R"({"future": [1, 2], "panels": {"tabs": false}})");
    const WindowMemory memory = memory_in(document, {}, "file");
    CHECK_FALSE(memory.panels.tabs);
    CHECK(memory.panels.settings);
    write_memory(memory, document);
    CHECK(document.at("future") == Json({1, 2}));
}

TEST_CASE("Window memory: a wrong value is refused with its name") {
    const auto failure = [](const char* text) -> std::string {
        try {
            memory_in(Json::parse(text), {}, "viewer.json");
        } catch (const Error& error) {
            CHECK(error.kind() == ErrorKind::Input);
            return error.what();
        }
        return "";
    };
    CHECK(failure(R"({"panels": {"settings_em": "wide"}})") ==
          "viewer.json: panels.settings_em: expected a number from 0 to 10000, got \"wide\"");
    CHECK_THAT(failure(R"({"layout": "classic"})"), contains("layout: expected one of explore, research"));
    CHECK_THAT(failure(R"({"ui_scale": 99})"), contains("ui_scale: expected a number from 0.75 to 2, got 99"));
    CHECK_THAT(failure(R"({"window": {"width": 1e30}})"), contains("window.width: expected a whole number"));
    CHECK_THAT(failure(R"({"window": 3})"), contains("expected an object, got 3"));
    CHECK_THAT(failure(R"({"recent": [3]})"), contains("recent: expected an array of names"));
    CHECK_THAT(failure(R"({"display": {"hemisphere": 1}})"), contains("display.hemisphere: expected true or false"));
}

TEST_CASE("Window memory: a model is restored, without what changes a picture") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    const RenderSettings before = model.render().settings();
    const WindowMemory wanted = changed_memory();
    restore(wanted, model);
    WindowMemory now = memory_of(model, wanted);
    REQUIRE_FALSE(now.recent.empty());
    CHECK(now.recent.front() == model.scene().name());  // the open scene is the newest
    now.recent.erase(now.recent.begin());
    CHECK(now == wanted);
    const RenderSettings& after = model.render().settings();
    CHECK(after.method == before.method);
    CHECK(after.next_event == before.next_event);
    CHECK(after.view == before.view);
    CHECK(after.seed == before.seed);
    CHECK(model.display().settings() == bench.options.display);
    // Hidden panels are for the moment.
    model.window().panels.shown = false;
    CHECK(memory_of(model, wanted).panels.shown);
}
