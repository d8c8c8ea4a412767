#include "core/base/error.h"
#include "tests/support/catch.hpp"
#include "tests/ui/worker_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Render worker: publishes frames that belong together") {
    Bench bench;
    RenderWorker worker(bench.setup());
    const auto frame = frame_of(worker, 0);
    REQUIRE(frame);
    CHECK(frame->snapshot.width == kSize);
    CHECK(frame->picture.width == kSize);
    CHECK(frame->picture.height == kSize);
    CHECK(frame->picture.pixels() != nullptr);
    CHECK_FALSE(frame->has_values());
    CHECK(frame->snapshot.passes >= 1);
    CHECK(frame->snapshot.counters.paths == std::uint64_t{frame->snapshot.passes} * kSize * kSize);
    CHECK(frame->divider == 1);
    CHECK(frame->backend.name == "cpu");
    CHECK(frame->description->name == "small");
    CHECK(frame->serial >= 1);
}

TEST_CASE("Render worker: a change stops a pass at rest, and the newest change wins") {
    Bench bench;
    RenderWorker worker(bench.setup());
    REQUIRE(frame_of(worker, 0));
    bench.control->hold = true;
    REQUIRE(eventually([&] { return bench.control->inside.load(); }));
    worker.submit(MethodId::Precomputed);
    worker.submit(EditCamera{camera_at(1.0f)});
    const std::uint64_t last = worker.submit(EditCamera{camera_at(2.0f)});
    CHECK(eventually([&] { return bench.control->stopped >= 1; }));
    bench.control->hold = false;
    const auto frame = frame_of(worker, last);
    REQUIRE(frame);
    CHECK(frame->settings.method == MethodId::Precomputed);
    CHECK(frame->snapshot.camera.eye.x == 2.0f);
    CHECK(frame->picture.pixels()[0] == gray_pixel(2.0f, {}));
}

TEST_CASE("Render worker: a click is answered before the end of the pass at rest") {
    Bench bench;
    RenderWorker worker(bench.setup());
    REQUIRE(frame_of(worker, 0));
    bench.control->hold = true;
    REQUIRE(eventually([&] { return bench.control->inside.load(); }));
    worker.request_pick({0.5f, 0.65f});
    CHECK(eventually([&] { return bench.control->stopped >= 1 && worker.take<PickAnswer>().has_value(); }));
    bench.control->hold = false;
}

TEST_CASE("Render worker: a change does not wait until the pass before it is measured") {
    Bench bench;
    bench.control->pass_microseconds = 2000;
    RenderWorker worker(bench.setup());
    REQUIRE(eventually([&] { return worker.status().passes >= 3; }));  // of those that are measured on no budget
    bench.control->finishes = true;
    bench.control->hold = true;
    REQUIRE(eventually([&] { return bench.control->inside.load(); }));
    const std::uint32_t before = worker.status().passes;
    const std::uint64_t change = worker.submit(MethodId::Precomputed);
    bench.control->hold = false;
    REQUIRE(frame_of(worker, change));
    const auto run = worker.runs()->runs.front();
    REQUIRE(run->label.method == MethodId::Default);
    CHECK(run->points.back().spp <= before);
}

TEST_CASE("Render worker: passes in motion are finished, or a hand that never rests would see no picture") {
    Bench bench;
    RenderWorker worker(bench.setup());
    REQUIRE(frame_of(worker, 0));
    worker.set_moving(true);
    const std::uint64_t first = worker.submit(EditCamera{camera_at(1.0f)});
    REQUIRE(frame_of(worker, first));
    bench.control->hold = true;
    REQUIRE(eventually([&] { return bench.control->inside.load(); }));
    const int stopped = bench.control->stopped;
    for (int i = 0; i < 20; ++i) worker.submit(EditCamera{camera_at(static_cast<float>(i))});
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK(bench.control->inside);
    CHECK(bench.control->stopped == stopped);
    bench.control->hold = false;
}

TEST_CASE("Render worker: a new camera clears the picture and keeps the learned field") {
    Bench bench;
    RenderWorker worker(bench.setup(MethodId::Reinforcement));
    REQUIRE(eventually([&] {
        const WorkerStatus status = worker.status();
        return status.field && status.field->passes >= 20;
    }));
    bench.control->pass_microseconds = 20000;  // so that the new picture cannot catch up
    const std::uint64_t generation = worker.submit(EditCamera{camera_at(1.0f)});
    const auto frame = frame_of(worker, generation);
    REQUIRE(frame);
    REQUIRE(frame->snapshot.field);
    CHECK(frame->snapshot.field->passes >= 20);
    CHECK(frame->snapshot.passes < 20);

    const std::uint64_t forgotten = worker.submit(EditForget{});
    const auto fresh = frame_of(worker, forgotten);
    REQUIRE(fresh);
    REQUIRE(fresh->snapshot.field);
    CHECK(fresh->snapshot.field->passes < 20);
}

// A field that is given after the start may come behind the first pass, which then shows an untrained one.
TEST_CASE("Render worker: the first picture begins with the learned field of its setup") {
    Bench bench;
    WorkerSetup setup = bench.setup(MethodId::Reinforcement);
    Session teacher(std::make_shared<FakeBackend>(bench.control), setup.scene, setup.settings);
    const FilmSlot slot{MethodId::Reinforcement, View::Beauty};
    while (teacher.passes(slot) < 16) teacher.advance(slot);
    setup.learned = std::make_shared<const LearnedField>(teacher.export_field(slot.method));
    setup.limits.spp = 1;
    RenderWorker worker(std::move(setup));
    const auto frame = frame_of(worker, 0);
    REQUIRE(frame);
    REQUIRE(frame->snapshot.field);
    CHECK(frame->snapshot.field->passes == 17);
}

TEST_CASE("Render worker: coarse in motion, and no coarse sample stays in the complete picture") {
    Bench bench;
    bench.control->pass_microseconds = 4000;  // of 64x64: 256 ms for the size below
    WorkerSetup setup = bench.setup();
    setup.settings.width = 512;
    setup.settings.height = 512;
    RenderWorker worker(std::move(setup));
    REQUIRE(frame_of(worker, 0));
    worker.set_moving(true);
    const std::uint64_t moved = worker.submit(EditCamera{camera_at(1.0f)});
    auto frame = frame_of(worker, moved);
    REQUIRE(frame);
    CHECK(frame->divider > 1);
    CHECK(frame->snapshot.width == 512 / frame->divider);
    CHECK(frame->settings.width == 512);
    CHECK(frame->snapshot.camera.eye.x == 1.0f);

    worker.set_moving(false);
    REQUIRE(eventually([&] {
        frame = worker.latest();
        return frame->divider == 1 && frame->generation >= moved;
    }));
    CHECK(frame->snapshot.width == 512);
    CHECK(frame->snapshot.counters.paths == std::uint64_t{frame->snapshot.passes} * 512 * 512);
}

TEST_CASE("Render worker: low resolution can be forbidden") {
    Bench bench;
    bench.control->pass_microseconds = 500;
    WorkerSetup setup = bench.setup();
    setup.settings.width = 512;
    setup.settings.height = 512;
    RenderWorker worker(std::move(setup));
    REQUIRE(frame_of(worker, 0));
    worker.set_low_resolution_allowed(false);
    worker.set_moving(true);
    const auto frame = frame_of(worker, worker.submit(EditCamera{camera_at(1.0f)}));
    REQUIRE(frame);
    CHECK(frame->divider == 1);
    CHECK(frame->snapshot.width == 512);
}

TEST_CASE("Render worker: a frame tells what lights its scene, with the materials as edited") {
    Bench bench;
    RenderWorker worker(bench.setup());
    const auto frame = frame_of(worker, 0);
    REQUIRE(frame);
    CHECK(frame->facts.light == SceneLight::Own);
    CHECK(frame->facts.diagonal == bounds_of(*small_scene()).diagonal());

    MaterialDescription off = small_scene()->materials[1];
    off.emission = glm::vec3{0.0f};
    const auto dark = frame_of(worker, worker.submit(EditMaterial{1, off}));
    REQUIRE(dark);
    CHECK(dark->facts.light == SceneLight::None);

    auto lit = std::make_shared<SceneDescription>(*small_scene());
    for (glm::vec3& position : lit->positions) position *= 3.0f;
    lit->materials[1] = off;
    add_default_light(*lit);
    const auto other = frame_of(worker, worker.submit(EditScene{lit}));
    REQUIRE(other);
    CHECK(other->facts.light == SceneLight::Default);
    CHECK(other->facts.diagonal == Approx(3.0f * frame->facts.diagonal));
}

TEST_CASE("Render worker: a pause rests, a step makes one pass, a camera gets one picture") {
    Bench bench;
    bench.control->pass_microseconds = 1000;
    RenderWorker worker(bench.setup());
    REQUIRE(frame_of(worker, 0));
    REQUIRE(rests(worker));
    const int passes = bench.control->passes;
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    CHECK(bench.control->passes == passes);

    worker.step();
    REQUIRE(eventually([&] { return bench.control->passes == passes + 1; }));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK(bench.control->passes == passes + 1);
    const std::uint32_t shown = worker.status().passes;
    CHECK(eventually([&] { return worker.latest()->snapshot.passes == shown; }));

    const auto moved = frame_of(worker, worker.submit(EditCamera{camera_at(3.0f)}));
    REQUIRE(moved);
    CHECK(moved->snapshot.passes == 1);
    CHECK(moved->snapshot.camera.eye.x == 3.0f);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK(worker.status().passes == 1);

    worker.set_paused(false);
    CHECK(eventually([&] { return worker.status().passes > 2; }));
}

TEST_CASE("Render worker: limits are met exactly and can be raised") {
    Bench bench;
    RenderWorker worker(bench.setup(MethodId::Default, {.spp = 5, .seconds = 0.0}));
    REQUIRE(eventually([&] { return worker.status().state == WorkerState::Done; }));
    CHECK(worker.status().passes == 5);
    CHECK(eventually([&] { return worker.latest() && worker.latest()->snapshot.passes == 5; }));
    worker.set_limits({.spp = 8, .seconds = 0.0});
    CHECK(eventually([&] { return worker.latest()->snapshot.passes == 8; }));
    CHECK(eventually([&] { return worker.status().state == WorkerState::Done; }));
    bench.control->pass_microseconds = 5000;
    worker.set_limits({.spp = 0, .seconds = 0.05});
    CHECK(eventually([&] { return worker.status().state == WorkerState::Done && worker.status().seconds >= 0.05; }));
}

TEST_CASE("Render worker: limits hold in a motion that is fast enough for the whole picture") {
    Bench bench;
    RenderWorker worker(bench.setup(MethodId::Default, {.spp = 5, .seconds = 0.0}));
    REQUIRE(frame_of(worker, 0));
    worker.set_moving(true);
    const std::uint64_t moved = worker.submit(EditCamera{camera_at(1.0f)});
    REQUIRE(frame_of(worker, moved));
    CHECK(eventually([&] { return worker.status().passes >= 5; }));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    worker.set_moving(false);
    REQUIRE(eventually([&] { return worker.status().state == WorkerState::Done; }));
    CHECK(worker.status().passes == 5);
    CHECK(eventually([&] { return worker.latest()->snapshot.passes == 5 && worker.latest()->generation >= moved; }));
}

TEST_CASE("Render worker: switching methods resumes the parked picture") {
    Bench bench;
    bench.control->pass_microseconds = 1000;
    RenderWorker worker(bench.setup());
    REQUIRE(eventually([&] { return worker.status().passes >= 10; }));
    worker.submit(MethodId::Reinforcement);
    REQUIRE(eventually([&] { return worker.latest()->snapshot.slot.method == MethodId::Reinforcement; }));
    const auto back = frame_of(worker, worker.submit(MethodId::Default));
    REQUIRE(back);
    CHECK(back->snapshot.slot.method == MethodId::Default);
    CHECK(back->snapshot.passes >= 10);
}

TEST_CASE("Render worker: the old picture stays until the radiance map is computed") {
    Bench bench;
    RenderWorker worker(bench.setup());
    REQUIRE(frame_of(worker, 0));
    bench.control->hold = true;
    worker.submit(MethodId::Precomputed);
    REQUIRE(eventually([&] { return worker.status().state == WorkerState::Precomputing || bench.control->inside; }));
    CHECK(worker.latest()->snapshot.slot.method == MethodId::Default);
    bench.control->hold = false;
    CHECK(eventually([&] { return worker.latest()->snapshot.slot.method == MethodId::Precomputed; }));
    CHECK(worker.latest()->snapshot.passes >= 1);
}

TEST_CASE("Render worker: a failing pass is reported, and the next change tries again") {
    Bench bench;
    RenderWorker worker(bench.setup());
    REQUIRE(frame_of(worker, 0));
    bench.control->fail = true;
    REQUIRE(eventually([&] { return worker.status().state == WorkerState::Failed; }));
    const auto messages = worker.take_messages();
    REQUIRE(messages.size() == 1);
    CHECK(messages[0].is_error);
    CHECK_THAT(messages[0].text, contains("the device is gone"));
    worker.submit(EditRestart{});
    CHECK(eventually([&] { return worker.status().state == WorkerState::Rendering; }));
}

TEST_CASE("Render worker: a back end that cannot be made is handed to the window") {
    WorkerSetup setup = Bench{}.setup();
    setup.make_backend = [](const std::string&) -> std::unique_ptr<RenderBackend> {
        throw Error(ErrorKind::Unavailable, "no such device");
    };
    RenderWorker worker(std::move(setup));
    REQUIRE(eventually([&] { return worker.failure() != nullptr; }));
    CHECK_THROWS_AS(std::rethrow_exception(worker.failure()), Error);
    CHECK_FALSE(worker.latest());
}

TEST_CASE("Render worker: ends at once, also from within a pass") {
    Bench bench;
    bench.control->hold = true;
    {
        RenderWorker worker(bench.setup());
        REQUIRE(eventually([&] { return bench.control->inside.load(); }));
    }
    CHECK_FALSE(bench.control->inside);
}
