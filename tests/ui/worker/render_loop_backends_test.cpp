// Back ends that fail or get lost while the worker renders, and the one that takes over.
#include "core/base/error.h"
#include "tests/support/catch.hpp"
#include "tests/ui/worker_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

/// The device with the tables is lost while the worker rests; the next request fails.
void lose_resting_device(RenderWorker& worker, Bench& bench) {
    learn_on_cuda(worker);
    REQUIRE(rests(worker));
    bench.devices.cuda->lost = true;
}

}  // namespace

TEST_CASE("Back-end switch: a failure on the way leaves the old one running, and may be tried again") {
    Bench bench;
    bench.control->pass_microseconds = 200;
    RenderWorker worker(bench.setup(MethodId::Reinforcement));
    REQUIRE(has_learned(worker, 5));
    const std::uint32_t passes = worker.status().passes;
    bench.devices.cuda->fail_upload = true;
    worker.switch_backend("cuda");
    REQUIRE(is_told(worker, "cannot switch to CUDA: the scene does not fit. CPU goes on"));
    bench.devices.cuda->fail_making = true;
    worker.switch_backend("cuda");
    REQUIRE(is_told(worker, "cannot switch to CUDA: the driver does not answer. CPU goes on"));
    CHECK(bench.devices.cuda->alive == 0);  // its memory is freed
    CHECK(worker.wanted_backend() == "cpu");
    CHECK(eventually([&] { return worker.status().passes > passes; }));
    CHECK(worker.status().backend == "cpu");
    CHECK(worker.status().field->passes >= 5);

    const auto frame = frame_of(worker, worker.switch_backend("cuda"));
    REQUIRE(frame);
    CHECK(frame->backend.name == "cuda");
    CHECK(frame->snapshot.field->passes >= 5);
}

TEST_CASE("Back-end switch: a failing pass hands over to the CPU with the learned fields") {
    Bench bench;
    bench.devices.cuda->pass_microseconds = 200;
    RenderWorker worker(bench.setup(MethodId::Reinforcement));
    learn_on_cuda(worker);
    worker.take_messages();
    const std::uint64_t learned = worker.status().field->passes;
    const std::uint64_t frames = worker.frame_count();
    bench.devices.cuda->fail = true;
    REQUIRE(is_told(worker, "CUDA failed: the device is gone. CPU takes over with the learned fields"));
    REQUIRE(eventually([&] { return worker.latest()->backend.name == "cpu"; }));
    CHECK(worker.latest()->serial > frames);
    CHECK(worker.latest()->settings.method == MethodId::Reinforcement);
    CHECK(worker.wanted_backend() == "cpu");
    CHECK(has_learned(worker, learned + 5));
    FakeControl& cuda = *bench.devices.cuda;
    const HostTables left = cuda.tables_in(cuda.downloaded, MethodId::Reinforcement);
    REQUIRE_FALSE(left.pending_sum.empty());
    CHECK(same_tables(left, bench.control->tables_in(bench.control->uploaded, MethodId::Reinforcement)));

    const WorkerStatus status = worker.status();
    CHECK(status.state == WorkerState::Rendering);
    CHECK((*status.backends)[1].failed == "the device is gone");
}

TEST_CASE("Back-end switch: one that failed may be tried again, and works if its device answers") {
    Bench bench;
    bench.devices.cuda->pass_microseconds = 200;
    RenderWorker worker(bench.setup(MethodId::Reinforcement));
    learn_on_cuda(worker);
    bench.devices.cuda->fail = true;
    REQUIRE(is_told(worker, "CUDA failed: the device is gone. CPU takes over with the learned fields"));
    bench.devices.cuda->fail_making = true;
    worker.switch_backend("cuda");
    REQUIRE(is_told(worker, "cannot switch to CUDA: the driver does not answer. CPU goes on"));
    CHECK((*worker.status().backends)[1].failed == "the device is gone");
    const std::uint64_t learned = worker.status().field->passes;

    const auto frame = frame_of(worker, worker.switch_backend("cuda"));
    REQUIRE(frame);
    CHECK(frame->backend.name == "cuda");
    CHECK(frame->snapshot.field->passes >= learned);
    CHECK((*worker.status().backends)[1].failed.empty());
    CHECK(bench.devices.cuda->made == 2);
    CHECK(bench.devices.cuda->alive == 1);  // the memory of the failed one is freed
}

TEST_CASE("Back-end switch: a parked one that fails on the way back is made anew for the next try") {
    Bench bench;
    bench.control->pass_microseconds = 200;
    RenderWorker worker(bench.setup(MethodId::Reinforcement));
    learn_on_cuda(worker);
    REQUIRE(frame_of(worker, worker.switch_backend("cpu")));
    bench.devices.cuda->lost = true;
    worker.switch_backend("cuda");
    REQUIRE(is_told(worker, "cannot switch to CUDA: the device is lost. CPU goes on"));
    CHECK(eventually([&] { return bench.devices.cuda->alive == 0; }));
    bench.devices.cuda->lost = false;
    const auto frame = frame_of(worker, worker.switch_backend("cuda"));
    REQUIRE(frame);
    CHECK(frame->backend.name == "cuda");
    CHECK(bench.devices.cuda->made == 2);
}

TEST_CASE("Back-end switch: a lost device hands over nothing, and the CPU learns anew") {
    Bench bench;
    bench.devices.cuda->pass_microseconds = 200;
    WorkerSetup setup = bench.setup(MethodId::Reinforcement);
    setup.first_backend = "cuda";
    RenderWorker worker(std::move(setup));
    REQUIRE(has_learned(worker, 200));
    const auto last = worker.latest();
    bench.control->hold = true;
    bench.devices.cuda->lost = true;
    REQUIRE(is_told(worker, "CUDA failed: the device is lost. CPU takes over; the learned fields are lost"));
    // Until the first picture of the CPU the window keeps the last one.
    REQUIRE(eventually([&] { return bench.control->inside.load(); }));
    CHECK(worker.latest()->backend.name == "cuda");
    CHECK(worker.latest()->serial >= last->serial);
    bench.control->pass_microseconds = 2000;
    bench.control->hold = false;
    REQUIRE(eventually([&] { return worker.latest()->backend.name == "cpu"; }));
    REQUIRE(worker.latest()->snapshot.field);
    CHECK(worker.latest()->snapshot.field->passes < 200);
    CHECK(bench.devices.cuda->alive == 0);
}

TEST_CASE("Back-end switch: an edit that finds the device lost is done by the CPU") {
    Bench bench;
    RenderWorker worker(bench.setup(MethodId::Reinforcement));
    lose_resting_device(worker, bench);
    auto scene = std::make_shared<SceneDescription>(*small_scene());
    scene->name = "other";
    scene->camera.eye.x = 3.0f;
    const auto frame = frame_of(worker, worker.submit(EditScene{scene}));
    REQUIRE(frame);
    CHECK(frame->backend.name == "cpu");
    CHECK(frame->description->name == "other");
    CHECK(frame->snapshot.camera.eye.x == 3.0f);
    CHECK(is_told(worker, "CUDA failed: the device is lost. CPU takes over"));
}

TEST_CASE("Back-end switch: leaving a lost device on purpose succeeds, too") {
    Bench bench;
    RenderWorker worker(bench.setup(MethodId::Reinforcement));
    lose_resting_device(worker, bench);
    const auto frame = frame_of(worker, worker.switch_backend("cpu"));
    REQUIRE(frame);
    CHECK(frame->backend.name == "cpu");
    CHECK(is_told(worker, "CUDA failed: the device is lost. CPU takes over; the learned fields are lost"));
    CHECK((*worker.status().backends)[1].failed == "the device is lost");
}

TEST_CASE("Back-end switch: a failure under the overlay of cells leaves method and view alone") {
    Bench bench;
    WorkerSetup setup = bench.setup(MethodId::Reinforcement);
    setup.first_backend = "cuda";
    RenderWorker worker(std::move(setup));
    REQUIRE(has_learned(worker, 5));
    REQUIRE(rests(worker));
    bench.devices.cuda->fail = true;  // the next pass renders the cells
    worker.set_cells_wanted(true);
    REQUIRE(is_told(worker, "CPU takes over with the learned fields"));
    REQUIRE(eventually([&] { return worker.latest()->backend.name == "cpu" && worker.latest()->cells; }));
    CHECK(worker.latest()->snapshot.slot == FilmSlot{MethodId::Reinforcement, View::Beauty});
    CHECK(worker.latest()->settings.view == View::Beauty);
}

TEST_CASE("Back-end switch: a first back end that cannot take the scene is replaced by the CPU") {
    Bench bench;
    WorkerSetup setup = bench.setup();
    setup.first_backend = "cuda";
    bench.devices.cuda->fail_upload = true;
    RenderWorker worker(std::move(setup));
    const auto frame = frame_of(worker, 0);
    REQUIRE(frame);
    CHECK(frame->backend.name == "cpu");
    CHECK(worker.wanted_backend() == "cpu");
    CHECK(worker.failure() == nullptr);
    CHECK(is_told(worker, "CUDA failed: the scene does not fit. CPU takes over"));
}

TEST_CASE("Back-end switch: where the CPU cannot take over the failure is reported, and no thread hangs") {
    Bench bench;
    WorkerSetup setup = bench.setup();
    setup.first_backend = "cuda";
    RenderWorker worker(std::move(setup));
    REQUIRE(frame_of(worker, 0));
    bench.control->fail_making = true;
    bench.devices.cuda->fail = true;
    REQUIRE(is_told(worker, "CUDA failed: the device is gone. No other back end can take over: the driver does not"));
    CHECK(eventually([&] { return worker.status().state == WorkerState::Failed; }));
    REQUIRE(worker.latest());
    const auto frame = frame_of(worker, worker.switch_backend("cpu"));
    REQUIRE(frame);
    CHECK(frame->backend.name == "cpu");
    CHECK(eventually([&] { return worker.status().state == WorkerState::Rendering; }));
}

TEST_CASE("Back-end switch: errors of requests break no back end") {
    CHECK_FALSE(is_fault_of_backend(Error(ErrorKind::Usage, "too many")));
    CHECK_FALSE(is_fault_of_backend(Error(ErrorKind::Input, "no such file")));
    CHECK(is_fault_of_backend(Error(ErrorKind::Unavailable, "lost")));
    CHECK(is_fault_of_backend(Error(ErrorKind::Runtime, "kernel")));
    CHECK(is_fault_of_backend(std::bad_alloc()));
}

TEST_CASE("Back-end switch: a reason does not name its back end twice") {
    CHECK(reason_of(Error(ErrorKind::Unavailable, "CUDA: out of memory"), "cuda") == "out of memory");
    CHECK(reason_of(Error(ErrorKind::Unavailable, "CUDA: out of memory"), "cpu") == "CUDA: out of memory");
    CHECK(reason_of(std::runtime_error("lost"), "cuda") == "lost");
}

TEST_CASE("Back-end switch: the window may close while the CPU takes over") {
    Bench bench;
    WorkerSetup setup = bench.setup();
    setup.first_backend = "cuda";
    auto worker = std::make_unique<RenderWorker>(std::move(setup));
    REQUIRE(frame_of(*worker, 0));
    bench.control->hold_upload = true;
    bench.devices.cuda->fail = true;
    REQUIRE(eventually([&] { return bench.control->uploading.load(); }));
    CHECK(ends_after(std::move(worker), [&] { bench.control->hold_upload = false; }));
    CHECK(bench.devices.cpu->alive == 0);
    CHECK(bench.devices.cuda->alive == 0);
}
