#include "ui/model/window_memory.h"

#include "core/io/files.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/temporary_folder.h"
#include "tests/ui/file_bench.h"

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
    memory.denoised_preview = false;
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

namespace {

WindowMemory memory_with_scale(float scale) {
    WindowMemory memory;
    memory.ui_scale = scale;
    return memory;
}

}  // namespace

TEST_CASE("Remembered window: a change is written after a rest, and read at the next start") {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "deep" / "viewer.json";
    Messages messages;
    RememberedWindow window(file, {});
    CHECK(window.problem().empty());
    window.update({}, 10.0, messages);
    window.update({}, 20.0, messages);
    CHECK_FALSE(std::filesystem::exists(file));  // nothing has changed
    window.update(memory_with_scale(1.5f), 21.0, messages);
    window.update(memory_with_scale(1.75f), 22.5, messages);  // still changing
    window.update(memory_with_scale(1.75f), 24.0, messages);
    CHECK_FALSE(std::filesystem::exists(file));
    window.update(memory_with_scale(1.75f), 24.6, messages);
    CHECK(RememberedWindow(file, {}).last() == memory_with_scale(1.75f));
    CHECK(messages.log().empty());
    // The end does not wait.
    CHECK(window.finish(memory_with_scale(1.0f)).empty());
    CHECK(RememberedWindow(file, {}).last() == memory_with_scale(1.0f));
}

TEST_CASE("Remembered window: broken, foreign and unreadable files leave the first start, and are replaced") {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "viewer.json";
    const WindowMemory first = memory_with_scale(1.25f);
    for (const std::string text :
         {"", "{", "[]", "\xff\xfe", "{\"schema\": 3}", "{\"schema\": \"pathlight.viewer/0\"}",
          "{\"schema\": \"pathlight.viewer/1\", \"ui_scale\": \"x\"}"}) {
        write_file_atomic(file, text);
        RememberedWindow window(file, first);
        CAPTURE(text);
        CHECK_THAT(window.problem(), contains("as at a first start") && contains("viewer.json"));
        CHECK(window.last() == first);
        CHECK(window.finish(memory_with_scale(2.0f)).empty());
        CHECK(RememberedWindow(file, first).last() == memory_with_scale(2.0f));
    }
    std::filesystem::remove(file);
    std::filesystem::create_directory(file);
    CHECK_FALSE(RememberedWindow(file, first).problem().empty());
}

TEST_CASE("Remembered window: a file that cannot be written is one message") {
    const TemporaryFolder folder;
    write_file_atomic(folder.path() / "file", "no folder");
    Messages messages;
    RememberedWindow window(folder.path() / "file" / "viewer.json", {});
    for (int second = 0; second < 20; ++second)
        window.update(memory_with_scale(second < 10 ? 1.5f : 1.0f), second, messages);
    REQUIRE(messages.log().size() == 1);
    CHECK_THAT(messages.log().front().text, contains("the window is not remembered"));
    CHECK_THAT(window.finish(memory_with_scale(2.0f)), contains("not remembered"));
}

TEST_CASE("Remembered window: forgetting removes the file until the next change") {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "viewer.json";
    Messages messages;
    RememberedWindow window(file, {});
    REQUIRE(window.finish(memory_with_scale(1.5f)).empty());
    window.forget({}, 10.0, messages);
    CHECK_FALSE(std::filesystem::exists(file));
    // The desktop moves the window to its place.
    WindowMemory placed;
    placed.place = WindowPlace{1, 2, 1440, 900, false};
    window.update(placed, 10.5, messages);
    window.update(placed, 20.0, messages);
    CHECK(window.finish(placed).empty());
    CHECK_FALSE(std::filesystem::exists(file));
    CHECK(window.finish(memory_with_scale(1.5f)).empty());
    CHECK(std::filesystem::exists(file));
}

TEST_CASE("Remembered window: without a file nothing is remembered") {
    Messages messages;
    RememberedWindow window("", {});
    for (int second = 0; second < 10; ++second) window.update(memory_with_scale(1.5f), second, messages);
    CHECK(window.finish(memory_with_scale(1.5f)).empty());
    CHECK(messages.log().empty());
}
