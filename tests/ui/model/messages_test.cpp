#include "tests/support/catch.hpp"
#include "ui/model/messages.h"

using namespace pl;
using namespace pl::ui;

TEST_CASE("Messages: toasts expire, errors later, and the log keeps both") {
    Messages messages;
    messages.set_time(1.0);
    messages.say(MessageLevel::Info, "saved");
    messages.say(MessageLevel::Error, "failed");
    messages.note(MessageLevel::Info, "opened");
    CHECK(messages.toasts().size() == 2);
    messages.set_time(5.5);
    messages.drop_expired();
    REQUIRE(messages.toasts().size() == 1);
    CHECK(messages.toasts()[0].text == "failed");
    messages.set_time(11.5);
    messages.drop_expired();
    CHECK(messages.toasts().empty());
    REQUIRE(messages.log().size() == 3);
    CHECK(messages.log()[2].text == "opened");
    CHECK(messages.log()[0].seconds == 1.0);
}

TEST_CASE("Messages: the oldest toasts and lines give way") {
    Messages messages;
    for (std::size_t i = 0; i < Messages::kMaxLogLines + 1; ++i) messages.say(MessageLevel::Info, std::to_string(i));
    CHECK(messages.log().size() == Messages::kMaxLogLines);
    CHECK(messages.log().front().text == "1");
    CHECK(messages.toasts().size() == Messages::kMaxToasts);
    CHECK(messages.toasts().back().text == std::to_string(Messages::kMaxLogLines));
}

TEST_CASE("Messages: the texts after some of them, as far as the log goes back") {
    Messages messages;
    messages.say(MessageLevel::Info, "copied");
    const std::uint64_t before = messages.count();
    CHECK(messages.texts_after(before).empty());
    messages.say(MessageLevel::Warning, "not reproducible");
    messages.note(MessageLevel::Info, "saved");
    CHECK(messages.texts_after(before) == "not reproducible\nsaved");
    CHECK(messages.texts_after(0) == "copied\nnot reproducible\nsaved");
    CHECK(messages.texts_after(100).empty());
    for (std::size_t i = 0; i < Messages::kMaxLogLines; ++i) messages.note(MessageLevel::Info, "x");
    CHECK(messages.count() == Messages::kMaxLogLines + 3);
    CHECK(messages.texts_after(0).size() == 2 * Messages::kMaxLogLines - 1);
}
