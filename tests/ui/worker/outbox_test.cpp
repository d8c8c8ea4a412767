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
    outbox.answer(LearnedAnswer{.field = nullptr, .reason = "none"});
    outbox.answer(DiagnosticsAnswer{.reason = "no paths", .generation = 4});
    outbox.report({false, "one"});
    outbox.report({true, "two"});
    CHECK(outbox.take_pick());
    CHECK_FALSE(outbox.take_pick());
    CHECK(outbox.take_learned()->reason == "none");
    CHECK_FALSE(outbox.take_learned());
    CHECK(outbox.take_diagnostics()->generation == 4);
    CHECK_FALSE(outbox.take_diagnostics());
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
