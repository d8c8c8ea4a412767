#include "core/io/files.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/temporary_folder.h"
#include "ui/model/remembered_window.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

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
        write_text_file_atomic(file, text);
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
    write_text_file_atomic(folder.path() / "file", "no folder");
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
