// Two methods in turns on the render thread, and how the viewer shows and ends them; over fake back ends.
#include "tests/support/catch.hpp"
#include "tests/ui/model_bench.h"
#include "tests/ui/worker_bench.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr TurnMethods kBoth{MethodId::Reinforcement, MethodId::Default};

bool both_rendered(const RenderWorker& worker, std::uint32_t passes) {
    const WorkerStatus status = worker.status();
    return status.turns && status.turns->passes[0] >= passes && status.turns->passes[1] >= passes;
}

struct TurnsBench : ModelBench {
    TurnsBench() : ModelBench(kSize) {
        options.settings.field.volumes = 16;
        options.settings.field.bins = 16;
    }
};

}  // namespace

TEST_CASE("Turns on the render thread: both methods get the same time, whatever a pass costs") {
    Bench bench;
    bench.control->pass_microseconds = 3000;
    RenderWorker worker(bench.setup(MethodId::Reinforcement));
    worker.set_turns(kBoth);
    REQUIRE(eventually([&] { return both_rendered(worker, 150); }));
    REQUIRE(rests(worker));
    const TurnsStatus turns = *worker.status().turns;
    // Two turns of a quarter of a second and a pass at most lie between them, on a machine as busy as it may be.
    CHECK_THAT(turns.seconds[0], WithinAbs(turns.seconds[1], 0.6));
    CHECK(worker.status().passes == turns.passes[0]);
}

TEST_CASE("Turns on the render thread: frames of both methods come out") {
    Bench bench;
    bench.control->pass_microseconds = 3000;
    RenderWorker worker(bench.setup(MethodId::Reinforcement));
    worker.set_turns(kBoth);
    for (const MethodId method : {MethodId::Default, MethodId::Reinforcement, MethodId::Default})
        CHECK(eventually([&] {
            const auto frame = worker.latest();
            return frame && frame->snapshot.slot.method == method;
        }));
}

TEST_CASE("Turns on the render thread: a camera that moves starts both over, an end leaves the session usable") {
    Bench bench;
    bench.control->pass_microseconds = 1000;
    RenderWorker worker(bench.setup(MethodId::Reinforcement));
    worker.set_turns(kBoth);
    REQUIRE(eventually([&] { return both_rendered(worker, 50); }));
    const std::uint64_t moved = worker.submit(EditCamera{camera_at(3.0f)});
    REQUIRE(frame_of(worker, moved));
    CHECK(eventually([&] { return both_rendered(worker, 2); }));
    worker.set_turns(std::nullopt);
    const std::uint64_t back = worker.submit(EditMethod{MethodId::Reinforcement});
    const auto frame = frame_of(worker, back);
    REQUIRE(frame);
    CHECK(frame->snapshot.slot.method == MethodId::Reinforcement);
    CHECK(eventually([&] { return !worker.status().turns.has_value(); }));
}

TEST_CASE("Turns on the render thread: limits end them, pauses hold them") {
    Bench bench;
    bench.control->pass_microseconds = 500;
    RenderWorker worker(bench.setup(MethodId::Reinforcement, {.spp = 8, .seconds = 0.0}));
    worker.set_turns(kBoth);
    REQUIRE(eventually([&] { return worker.status().state == WorkerState::Done; }));
    const TurnsStatus done = *worker.status().turns;
    CHECK(std::max(done.passes[0], done.passes[1]) == 8);
    CHECK(std::min(done.passes[0], done.passes[1]) >= 1);
    CHECK_THAT(done.seconds[0], WithinAbs(done.seconds[1], 0.1));  // the one that is behind has caught up
    REQUIRE(rests(worker));
    worker.set_limits({});
    worker.set_paused(false);
    CHECK(eventually([&] { return both_rendered(worker, 10); }));
}

// The first pass is cut, so that time is charged for no sample: placing volumes takes longer than all passes of the other.
TEST_CASE("Turns on the render thread: a limit waits for the first pass of both methods") {
    Bench bench;
    bench.control->hold = true;
    RenderWorker worker(bench.setup(MethodId::Reinforcement, {.spp = 8, .seconds = 0.0}));
    REQUIRE(eventually([&] { return bench.control->inside.load(); }));
    worker.set_turns(kBoth);
    REQUIRE(eventually([&] { return bench.control->stopped > 0; }));
    bench.control->hold = false;
    REQUIRE(eventually([&] { return worker.status().state == WorkerState::Done; }));
    const TurnsStatus done = *worker.status().turns;
    CHECK(done.passes[0] >= 1);
    CHECK(done.passes[1] == 8);
}

TEST_CASE("Viewer model: in turns the picture is split, and each side keeps the newest frame of its method") {
    TurnsBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.frame() != nullptr; }));
    model.set_method(MethodId::Reinforcement);
    model.set_turns(true);
    CHECK(model.turns());
    CHECK(model.window().compare.mode == CompareMode::Split);
    const auto plan = [&] { return model.compare_plan({0.0f, 0.0f, 400.0f, 400.0f}); };
    REQUIRE(bench.run_until(model, [&] { return plan().tiles.size() == 2; }));
    REQUIRE(bench.run_until(model, [&] { return plan().tiles[0].content.frame && plan().tiles[1].content.frame; }));
    CHECK(plan().tiles[0].content.frame->snapshot.slot.method == MethodId::Reinforcement);
    CHECK(plan().tiles[1].content.frame->snapshot.slot.method == MethodId::Default);
    CHECK(model.frame()->snapshot.slot.method == MethodId::Reinforcement);
}

TEST_CASE("Viewer model: choosing a method ends turns, with that method") {
    TurnsBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.frame() != nullptr; }));
    model.set_turns(true);  // default, and what is compared with it
    REQUIRE(bench.run_until(model, [&] { return model.status().turns && model.status().turns->passes[1] > 0; }));
    model.set_method(MethodId::Default);  // the one that it is already
    CHECK_FALSE(model.turns());
    CHECK(bench.run_until(
        model, [&] { return !model.status().turns && model.frame()->snapshot.slot.method == MethodId::Default; }));
    model.set_turns(true);
    model.set_turns(false);
    CHECK_FALSE(model.turns());
    CHECK(model.settings().method == MethodId::Default);
}
