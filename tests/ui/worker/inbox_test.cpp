#include "ui/worker/inbox.h"

#include <thread>

#include "tests/support/catch.hpp"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

using Interrupts = Inbox::Interrupts;

Interrupts nothing(Requests&) { return Interrupts::Nothing; }
bool is_idle() { return false; }
bool is_busy() { return true; }

}  // namespace

TEST_CASE("Inbox: requests hold, questions and edits are handed over once") {
    Inbox inbox(Requests{.backend = "cpu"});
    CHECK(inbox.submit(EditSeed{3}) == 1);
    inbox.request([](Requests& requests) {
        requests.paused = true;
        requests.once.learned = true;
        return Interrupts::Nothing;
    });
    Requests now;
    std::vector<WorkerEdit> edits;
    REQUIRE(inbox.take(now, edits, is_idle));
    CHECK(edits.size() == 1);
    CHECK(now.paused);
    CHECK(now.once.learned);
    CHECK(now.generation == 1);
    REQUIRE(inbox.take(now, edits, is_busy));
    CHECK(edits.empty());
    CHECK(now.paused);
    CHECK_FALSE(now.once.learned);
}

TEST_CASE("Inbox: edits submitted together are taken together") {
    Inbox inbox(Requests{});
    constexpr std::uint32_t kPairs = 2000;
    std::thread window([&] {
        for (std::uint32_t i = 1; i <= kPairs; ++i) inbox.submit_together({EditSeed{i}, EditRestart{}});
        inbox.quit();
    });
    Requests now;
    std::vector<WorkerEdit> edits;
    std::uint32_t apart = 0;
    while (inbox.take(now, edits, is_busy)) apart += edits.size() == 1;
    window.join();
    CHECK(apart == 0);
}

TEST_CASE("Inbox: waits for edits, and for the end") {
    Inbox inbox(Requests{});
    std::thread other([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        inbox.submit(EditRestart{});
    });
    Requests now;
    std::vector<WorkerEdit> edits;
    CHECK(inbox.take(now, edits, is_idle));
    CHECK(edits.size() == 1);
    other.join();
    inbox.quit();
    CHECK_FALSE(inbox.take(now, edits, is_busy));
    CHECK(*inbox.stop_flag());
}

TEST_CASE("Inbox: edits stop a pass that may be interrupted, a frame only that of a film with passes") {
    Inbox inbox(Requests{});
    Requests now;
    std::vector<WorkerEdit> edits;
    const auto stops = [&](bool may_be_interrupted, bool has_pass, const auto& act) {
        REQUIRE(inbox.take(now, edits, is_busy));
        inbox.note_film(has_pass);
        inbox.begin_pass(may_be_interrupted, now, now.backend);
        CHECK_FALSE(*inbox.stop_flag());
        act();
        return inbox.stop_flag()->load();
    };
    const auto edit = [&] { inbox.submit(EditRestart{}); };
    const auto frame = [&] { inbox.request([](Requests&) { return Interrupts::ShownPass; }); };
    CHECK(stops(true, false, edit));
    CHECK_FALSE(stops(false, true, edit));
    CHECK(stops(true, true, frame));
    CHECK_FALSE(stops(true, false, frame));
    CHECK_FALSE(stops(true, true, [&] { inbox.request(nothing); }));
}

TEST_CASE("Inbox: a request that comes before a pass is known to be interruptible stops it as well") {
    Inbox inbox(Requests{.backend = "cpu"});
    Requests now;
    std::vector<WorkerEdit> edits;
    REQUIRE(inbox.take(now, edits, is_busy));
    inbox.submit(EditRestart{});
    CHECK_FALSE(*inbox.stop_flag());
    inbox.begin_pass(true, now, "cpu");
    CHECK(*inbox.stop_flag());
}

TEST_CASE("Inbox: a settled back end leaves a newer request alone") {
    Inbox inbox(Requests{.backend = "cuda"});
    inbox.settle_backend("cuda", "cpu");
    CHECK(inbox.wanted_backend() == "cpu");
    inbox.request([](Requests& requests) {
        requests.backend = "cuda";
        return Interrupts::Pass;
    });
    inbox.settle_backend("cpu", "cpu");
    CHECK(inbox.wanted_backend() == "cuda");
}
