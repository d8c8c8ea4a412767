#include "ui/worker/outbox.h"

#include "tests/support/catch.hpp"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Outbox: frames are numbered, and the window tells by taking one that it has seen it") {
    Outbox outbox(WorkerStatus{});
    CHECK_FALSE(outbox.latest());
    CHECK(outbox.frame_count() == 0);
    outbox.publish(std::make_shared<PublishedFrame>());
    outbox.publish(std::make_shared<PublishedFrame>());
    CHECK(outbox.frame_count() == 2);
    CHECK_FALSE(outbox.is_frame_taken());
    CHECK(outbox.latest()->serial == 2);
    CHECK(outbox.is_frame_taken());
}

TEST_CASE("Outbox: answers and messages are taken once, status and runs stay") {
    Outbox outbox(WorkerStatus{});
    outbox.answer(PickAnswer{});
    outbox.answer(LearnedAnswer{.value = nullptr, .reason = "none"});
    outbox.answer(DiagnosticsAnswer{.reason = "no paths", .generation = 4});
    outbox.report({false, "one"});
    outbox.report({true, "two"});
    CHECK(outbox.take<PickAnswer>());
    CHECK_FALSE(outbox.take<PickAnswer>());
    CHECK(outbox.take<LearnedAnswer>()->reason == "none");
    CHECK_FALSE(outbox.take<LearnedAnswer>());
    CHECK(outbox.take<DiagnosticsAnswer>()->generation == 4);
    CHECK_FALSE(outbox.take<DiagnosticsAnswer>());
    const auto messages = outbox.take_messages();
    REQUIRE(messages.size() == 2);
    CHECK(messages[1].text == "two");
    CHECK(outbox.take_messages().empty());
    WorkerStatus status;
    status.passes = 7;
    outbox.set_status(status);
    CHECK(outbox.status().passes == 7);
    outbox.fail(std::make_exception_ptr(1));
    CHECK(outbox.failure());
    CHECK(outbox.status().state == WorkerState::Failed);
    CHECK(outbox.status().passes == 7);
}
