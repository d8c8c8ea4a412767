#include "ui/worker/inbox.h"

#include <thread>

#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Edit queue: of each kind only the newest is left, in order of its arrival") {
    EditQueue queue;
    CHECK(queue.empty());
    CameraDescription first;
    first.fov_deg = 10.0f;
    CameraDescription second;
    second.fov_deg = 20.0f;
    queue.push(EditCamera{first});
    queue.push(EditScene{nullptr});
    queue.push(MethodId::Precomputed);
    queue.push(EditCamera{second});
    queue.push(MethodId::Reinforcement);
    const auto edits = queue.take();
    CHECK(queue.empty());
    REQUIRE(edits.size() == 3);
    // A camera edit after a scene edit must be applied after it: a new scene has its own camera.
    CHECK(find_edit<EditScene>(edits[0]));
    REQUIRE(find_edit<EditCamera>(edits[1]));
    CHECK(find_edit<EditCamera>(edits[1])->camera.fov_deg == 20.0f);
    CHECK(std::get<MethodId>(edits[2]) == MethodId::Reinforcement);
}

TEST_CASE("Edit queue: of each material only the newest edit is left, and a scene replaces them all") {
    EditQueue queue;
    queue.push(EditMaterial{0, gray(0.1f)});
    queue.push(EditMaterial{1, gray(0.2f)});
    queue.push(EditMaterial{0, gray(0.3f)});
    queue.push(EditSeed{1});
    auto edits = queue.take();
    REQUIRE(edits.size() == 3);
    CHECK(find_edit<EditMaterial>(edits[0])->index == 1);
    CHECK(find_edit<EditMaterial>(edits[1])->material.albedo.x == 0.3f);
    queue.push(EditMaterial{5, gray(0.4f)});
    queue.push(EditScene{nullptr});
    queue.push(EditMaterial{0, gray(0.5f)});
    edits = queue.take();
    REQUIRE(edits.size() == 2);
    CHECK(find_edit<EditScene>(edits[0]));
}

TEST_CASE("Edit queue: every volume that is to be forgotten is left once, until all or another scene's are") {
    EditQueue queue;
    queue.push(EditForgetVolume{MethodId::Reinforcement, 3});
    queue.push(EditForgetVolume{MethodId::Reinforcement, 5});
    queue.push(EditForgetVolume{MethodId::Reinforcement, 3});
    queue.push(EditSeed{1});
    auto edits = queue.take();
    REQUIRE(edits.size() == 3);
    CHECK(find_edit<EditForgetVolume>(edits[0])->volume == 5);
    CHECK(find_edit<EditForgetVolume>(edits[1])->volume == 3);
    queue.push(EditForgetVolume{MethodId::Reinforcement, 3});
    queue.push(EditForget{});
    edits = queue.take();
    REQUIRE(edits.size() == 1);
    CHECK(find_edit<EditForget>(edits[0]));
}

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
    CHECK(*inbox.edit_flag());
    CHECK_FALSE(stops(false, true, edit));
    CHECK_FALSE(*inbox.edit_flag());
    CHECK(stops(true, true, frame));
    CHECK_FALSE(*inbox.edit_flag());
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
    CHECK(*inbox.edit_flag());
}

TEST_CASE("Inbox: a click stops the pass at rest that begins after it") {
    Inbox inbox(Requests{.backend = "cpu"});
    Requests now;
    std::vector<WorkerEdit> edits;
    REQUIRE(inbox.take(now, edits, is_busy));
    inbox.request([](Requests& requests) {
        requests.once.pick = Vec2f{0.5f};
        return Interrupts::Pass;
    });
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
