// Changing the back end while the worker renders.
#include <algorithm>

#include "tests/support/catch.hpp"
#include "tests/ui/worker_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Back-end switch: method, view, camera and field stay, and tables move to the bit, both ways") {
    Bench bench;
    RenderWorker worker(bench.setup(MethodId::Reinforcement));
    worker.submit(EditCamera{camera_at(1.5f)});
    REQUIRE(has_learned(worker, 7));
    const auto there = frame_of(worker, worker.switch_backend("cuda"));
    REQUIRE(there);
    CHECK(there->backend.name == "cuda");
    CHECK(there->settings.method == MethodId::Reinforcement);
    CHECK(there->settings.view == View::Beauty);
    CHECK(there->snapshot.camera.eye.x == 1.5f);
    REQUIRE(there->snapshot.field);
    CHECK(there->snapshot.field->passes >= 7);
    FakeControl& cpu = *bench.devices.cpu;
    FakeControl& cuda = *bench.devices.cuda;
    const HostTables left = cpu.tables_in(cpu.downloaded, MethodId::Reinforcement);
    REQUIRE_FALSE(left.pending_sum.empty());
    CHECK(std::ranges::any_of(left.radiance, [](float radiance) { return radiance > 0.0f; }));
    CHECK(same_tables(left, cuda.tables_in(cuda.uploaded, MethodId::Reinforcement)));

    REQUIRE(has_learned(worker, 20));
    const auto back = frame_of(worker, worker.switch_backend("cpu"));
    REQUIRE(back);
    CHECK(back->backend.name == "cpu");
    CHECK(back->snapshot.field->passes >= 20);
    const HostTables returned = cuda.tables_in(cuda.downloaded, MethodId::Reinforcement);
    CHECK_FALSE(same_tables(left, returned));
    CHECK(same_tables(returned, cpu.tables_in(cpu.uploaded, MethodId::Reinforcement)));
    CHECK(cpu.made == 1);
    CHECK(cuda.made == 1);
}

TEST_CASE("Back-end switch: pictures are parked, and a parked one is shown before the next pass") {
    Bench bench;
    bench.control->pass_microseconds = 500;
    bench.devices.cuda->pass_microseconds = 500;
    RenderWorker worker(bench.setup());
    REQUIRE(eventually([&] { return worker.status().passes >= 10; }));
    REQUIRE(frame_of(worker, worker.switch_backend("cuda")));
    REQUIRE(eventually([&] { return worker.status().passes >= 3; }));
    bench.control->hold = true;  // the CPU gets no pass done
    const auto back = frame_of(worker, worker.switch_backend("cpu"));
    REQUIRE(back);
    CHECK(back->backend.name == "cpu");
    CHECK(back->snapshot.passes >= 10);
    CHECK(back->snapshot.counters.paths >= std::uint64_t{10} * kSize * kSize);
    const std::uint32_t parked = back->snapshot.passes;
    bench.control->hold = false;
    CHECK(eventually([&] { return worker.status().passes > parked; }));
}

TEST_CASE("Back-end switch: a camera that moved meanwhile empties the parked picture, too") {
    Bench bench;
    bench.control->pass_microseconds = 500;
    RenderWorker worker(bench.setup());
    worker.set_values_wanted(true);
    REQUIRE(eventually([&] { return worker.status().passes >= 10; }));
    REQUIRE(frame_of(worker, worker.switch_backend("cuda")));
    REQUIRE(frame_of(worker, worker.submit(EditCamera{camera_at(2.0f)})));
    const auto back = frame_of(worker, worker.switch_backend("cpu"));
    REQUIRE(back);
    CHECK(back->backend.name == "cpu");
    CHECK(back->snapshot.pixels[0].x == 2.0f);
    CHECK(back->snapshot.passes < 10);
}

TEST_CASE("Back-end switch: interrupts the pass under way") {
    Bench bench;
    RenderWorker worker(bench.setup());
    REQUIRE(frame_of(worker, 0));
    bench.control->hold = true;
    REQUIRE(eventually([&] { return bench.control->inside.load(); }));
    const auto frame = frame_of(worker, worker.switch_backend("cuda"));
    REQUIRE(frame);
    CHECK(frame->backend.name == "cuda");
    CHECK(bench.control->stopped == 1);
    bench.control->hold = false;
}

TEST_CASE("Back-end switch: a paused picture follows with one pass") {
    Bench bench;
    RenderWorker worker(bench.setup());
    REQUIRE(frame_of(worker, 0));
    REQUIRE(rests(worker));
    const auto frame = frame_of(worker, worker.switch_backend("cuda"));
    REQUIRE(frame);
    CHECK(frame->backend.name == "cuda");
    CHECK(frame->snapshot.passes == 1);
    CHECK(eventually([&] { return worker.status().state == WorkerState::Paused; }));
}

TEST_CASE("Back-end switch: one that is unavailable leaves all as it is") {
    Bench bench;
    WorkerSetup setup = bench.setup();
    setup.backends[1].unavailable = "no driver";
    RenderWorker worker(std::move(setup));
    REQUIRE(eventually([&] { return worker.status().passes >= 3; }));
    worker.switch_backend("cuda");
    REQUIRE(is_told(worker, "cannot switch to CUDA: no driver. CPU goes on"));
    CHECK(worker.wanted_backend() == "cpu");
    CHECK(worker.status().backend == "cpu");
    CHECK(worker.status().passes >= 3);
    CHECK(bench.devices.cuda->made == 0);
}

TEST_CASE("Back-end switch: of many requests in a hurry the last one counts") {
    Bench bench;
    RenderWorker worker(bench.setup(MethodId::Reinforcement));
    REQUIRE(has_learned(worker, 3));
    for (const int presses : {31, 50, 1}) {
        const std::string before = worker.wanted_backend();
        std::uint64_t generation = 0;
        for (int press = 0; press < presses; ++press) {
            generation = worker.switch_backend(worker.wanted_backend() == "cpu" ? "cuda" : "cpu");
            if (press % 7 == 0) std::this_thread::sleep_for(std::chrono::microseconds(300));
        }
        const std::string asked = presses % 2 == 0 ? before : (before == "cpu" ? "cuda" : "cpu");
        const auto frame = frame_of(worker, generation);
        REQUIRE(frame);
        CHECK(frame->backend.name == asked);
        CHECK(worker.wanted_backend() == asked);
        CHECK(eventually([&] { return worker.status().backend == asked; }));
    }
    CHECK(bench.devices.cpu->made == 1);
    CHECK(bench.devices.cuda->made == 1);
    const std::uint64_t learned = worker.status().field->passes;
    CHECK(has_learned(worker, learned + 3));
}

TEST_CASE("Back-end switch: another request while a back end is made") {
    Bench bench;
    RenderWorker worker(bench.setup());
    REQUIRE(frame_of(worker, 0));
    bench.devices.cuda->hold_upload = true;
    worker.switch_backend("cuda");
    REQUIRE(eventually([&] { return bench.devices.cuda->uploading.load(); }));
    const std::uint64_t generation = worker.switch_backend("cpu");
    CHECK(worker.wanted_backend() == "cpu");
    bench.devices.cuda->hold_upload = false;
    const auto frame = frame_of(worker, generation);
    REQUIRE(frame);
    CHECK(frame->backend.name == "cpu");
    CHECK(eventually([&] { return worker.status().backend == "cpu"; }));
}

TEST_CASE("Back-end switch: the window may close in the middle of one") {
    Bench bench;
    auto worker = std::make_unique<RenderWorker>(bench.setup(MethodId::Reinforcement));
    REQUIRE(has_learned(*worker, 3));
    bench.devices.cuda->hold_upload = true;
    worker->switch_backend("cuda");
    REQUIRE(eventually([&] { return bench.devices.cuda->uploading.load(); }));
    CHECK(ends_after(std::move(worker), [&] { bench.devices.cuda->hold_upload = false; }));
    CHECK(bench.devices.cpu->alive == 0);
    CHECK(bench.devices.cuda->alive == 0);
}
