#include <future>

#include "core/base/error.h"
#include "tests/catch.hpp"
#include "tests/ui/worker_bench.h"

using namespace pl;
using namespace pl::test;

namespace {

/// Waits for a message that contains the text; all others before it are dropped.
bool is_told(RenderWorker& worker, const std::string& text) {
    return eventually([&] {
        for (const WorkerMessage& message : worker.take_messages())
            if (message.text.find(text) != std::string::npos) return true;
        return false;
    });
}

bool has_learned(RenderWorker& worker, std::uint64_t passes) {
    return eventually([&] {
        const WorkerStatus status = worker.status();
        return status.field && status.field->passes >= passes;
    });
}

/// A worker that has learned something on CUDA.
void learn_on_cuda(RenderWorker& worker) {
    REQUIRE(has_learned(worker, 5));
    REQUIRE(frame_of(worker, worker.switch_backend("cuda")));
    REQUIRE(has_learned(worker, 10));
}

/// The device that has learned is lost while the worker rests, which nobody notices before the next order.
void lose_resting_device(RenderWorker& worker, Bench& bench) {
    learn_on_cuda(worker);
    REQUIRE(rests(worker));
    bench.devices.cuda->lost = true;
}

/// Destroys a worker on another thread, so that a test can do without its end.
template <class Release>
bool ends_after(std::unique_ptr<RenderWorker> worker, Release&& release) {
    std::future<void> end = std::async(std::launch::async, [&] { worker.reset(); });
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    release();
    return end.wait_for(std::chrono::seconds(10)) == std::future_status::ready;
}

}  // namespace

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
    CHECK(left.radiance[0] > 0.0f);
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

TEST_CASE("Back-end switch: cuts the pass under way") {
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
    CHECK(bench.devices.cuda->alive == 0);  // what could not take the scene gives back its memory
    CHECK(worker.wanted_backend() == "cpu");
    CHECK(eventually([&] { return worker.status().passes > passes; }));
    CHECK(worker.status().backend == "cpu");
    CHECK(worker.status().field->passes >= 5);

    const auto frame = frame_of(worker, worker.switch_backend("cuda"));
    REQUIRE(frame);
    CHECK(frame->backend.name == "cuda");
    CHECK(frame->snapshot.field->passes >= 5);
}

TEST_CASE("Back-end switch: a failing pass hands over to the CPU with what was learned") {
    Bench bench;
    bench.devices.cuda->pass_microseconds = 200;
    RenderWorker worker(bench.setup(MethodId::Reinforcement));
    learn_on_cuda(worker);
    worker.take_messages();
    const std::uint64_t learned = worker.status().field->passes;
    const std::uint64_t frames = worker.frame_count();
    bench.devices.cuda->fail = true;
    REQUIRE(is_told(worker, "CUDA failed: the device is gone. CPU takes over with what was learned"));
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
    REQUIRE(is_told(worker, "CUDA failed: the device is gone. CPU takes over with what was learned"));
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
    CHECK(bench.devices.cuda->alive == 1);  // what broke gave back its memory
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
    REQUIRE(is_told(worker, "CUDA failed: the device is lost. CPU takes over; what was learned is lost"));
    // Until the CPU has a picture the window keeps the last one.
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
    CHECK(is_told(worker, "CUDA failed: the device is lost. CPU takes over; what was learned is lost"));
    CHECK((*worker.status().backends)[1].failed == "the device is lost");
}

TEST_CASE("Back-end switch: a failure under the overlay of cells leaves method and view alone") {
    Bench bench;
    WorkerSetup setup = bench.setup(MethodId::Reinforcement);
    setup.first_backend = "cuda";
    RenderWorker worker(std::move(setup));
    REQUIRE(has_learned(worker, 5));
    REQUIRE(rests(worker));
    bench.devices.cuda->fail = true;  // the next pass is that of the cells
    worker.set_cells_wanted(true);
    REQUIRE(is_told(worker, "CPU takes over with what was learned"));
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

TEST_CASE("Back-end switch: where the CPU cannot take over the failure is told, and nothing hangs") {
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

TEST_CASE("Back-end switch: complaints about what was asked for break no back end") {
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

TEST_CASE("Back-end switch: of many wishes in a hurry the last one counts") {
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

TEST_CASE("Back-end switch: a change of mind while the other one is made") {
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
