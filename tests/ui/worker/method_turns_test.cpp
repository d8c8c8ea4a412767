#include "ui/worker/method_turns.h"

#include <cmath>
#include <vector>

#include "tests/support/catch.hpp"
#include "tests/ui/worker/session_bench.h"
#include "tests/ui/worker_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Turns: short passes go A, B, B, A in turns of equal time") {
    Turns turns(0.25);
    std::array<double, 2> charged{};
    std::vector<std::size_t> order;
    for (int pass = 0; pass < 400; ++pass) {
        const std::size_t side = turns.next(charged);
        if (order.empty() || order.back() != side) order.push_back(side);
        charged[side] += 0.01;
        CHECK(std::fabs(charged[0] - charged[1]) <= 0.5 + 0.011);
    }
    // Neighboring turns of one side look like one.
    CHECK((std::vector<std::size_t>(order.begin(), order.begin() + 6) == std::vector<std::size_t>{0, 1, 0, 1, 0, 1}));
    CHECK_FALSE(turns.catching_up());
}

TEST_CASE("Turns: passes longer than a turn are paid for with later turns") {
    Turns turns(0.25);
    std::array<double, 2> charged{};
    std::array<int, 2> passes{};
    for (int pass = 0; pass < 1000; ++pass) {
        const std::size_t side = turns.next(charged);
        charged[side] += side == 0 ? 1.7 : 0.03;
        ++passes[side];
        REQUIRE(std::fabs(charged[0] - charged[1]) <= 0.5 + 1.71);
    }
    CHECK(passes[0] > 10);
    CHECK_THAT(static_cast<double>(passes[1]) / passes[0], WithinRel(1.7 / 0.03, 0.2));
}

TEST_CASE("Turns: the side that is behind catches up first, also when one starts over") {
    Turns turns(0.25);
    std::array<double, 2> charged{5.0, 0.0};
    while (charged[1] < 5.0) {
        REQUIRE(turns.next(charged) == 1);
        CHECK(turns.catching_up());
        charged[1] += 0.1;
    }
    (void)turns.next(charged);
    CHECK_FALSE(turns.catching_up());
    charged = {6.0, 0.02};  // its picture was emptied
    CHECK(turns.next(charged) == 1);
    CHECK(turns.catching_up());
    charged = {0.0, 0.0};
    CHECK(turns.next(charged) == 0);
    CHECK_FALSE(turns.catching_up());
}

namespace {

const TurnSides kBoth{.methods = {MethodId::Reinforcement, MethodId::Default}, .second = nullptr};

bool both_rendered(const RenderWorker& worker, std::uint32_t passes) {
    const WorkerStatus status = worker.status();
    return status.turns && status.turns->passes[0] >= passes && status.turns->passes[1] >= passes;
}

}  // namespace

TEST_CASE("Method turns: both films are counted, the field is that of the first side") {
    SessionBench bench;
    bench.render(kLearning, 3);
    bench.render(kDefault, 2);
    MethodTurns turns(kBoth);
    for (const std::size_t side : {0u, 1u}) turns.count(side, bench.session, View::Beauty);
    CHECK(turns.status().passes == std::array<std::uint32_t, 2>{3, 2});
    REQUIRE(turns.field());
    CHECK(turns.field()->passes == 3);
    CHECK(turns.status().sides.methods[turns.side()] == MethodId::Reinforcement);
    turns.set_side(1);
    CHECK(turns.status().sides.methods[turns.side()] == MethodId::Default);
    CHECK(turns.first() == MethodId::Reinforcement);
    bench.render(kDefault, 1);
    turns.count(1, bench.session, View::Beauty);
    CHECK(turns.status().passes == std::array<std::uint32_t, 2>{3, 3});
}

TEST_CASE("Method turns: a method at its limit waits until the other has had a pass and the same time") {
    SessionBench bench;
    bench.render(kLearning, 4);
    MethodTurns turns(kBoth);
    Requests now{.limits = {.spp = 4, .seconds = 0.0}};
    for (const std::size_t side : {0u, 1u}) turns.count(side, bench.session, View::Beauty);
    CHECK(turns.side_at_limit(now) == 1u);
    CHECK_FALSE(turns.limit_reached(now));
    CHECK(turns.next(false, now) == 1);
    CHECK(turns.next(true, now) == 0);
    bench.render(kDefault, 4);
    for (const std::size_t side : {0u, 1u}) turns.count(side, bench.session, View::Beauty);
    CHECK(turns.limit_reached(now));
    now.limits = {};
    CHECK_FALSE(turns.side_at_limit(now));
}

TEST_CASE("Turns on the render thread: both methods get the same time, however long their passes") {
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
    const std::uint64_t back = worker.submit(MethodId::Reinforcement);
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
    const std::size_t limited = done.passes[0] == 8 ? 0 : 1;
    const std::size_t other = 1 - limited;  // it has caught up
    CHECK((done.passes[other] == 8 || done.seconds[other] >= done.seconds[limited]));
    REQUIRE(rests(worker));
    worker.set_limits({});
    worker.set_paused(false);
    CHECK(eventually([&] { return both_rendered(worker, 10); }));
}

namespace {

/// Whether the last passes of both sides are measured, once they are; measuring is dear beside fake passes.
bool are_measured(RenderWorker& worker) {
    return eventually([&] {
        const auto runs = worker.runs()->runs;
        const auto turns = worker.status().turns;
        const auto is_measured = [&](std::size_t side) {
            return std::ranges::any_of(runs, [&](const auto& run) {
                return run->label.method == turns->sides.methods[side] &&
                       run->points.back().spp == turns->passes[side];
            });
        };
        return turns && is_measured(0) && is_measured(1);
    });
}

}  // namespace

TEST_CASE("Turns on the render thread: at rest the last passes of both are measured, whoever met a limit") {
    Bench bench;
    bench.control->pass_microseconds = 500;
    RenderWorker worker(bench.setup(MethodId::Reinforcement, {.spp = 60, .seconds = 0.0}));
    worker.set_turns(kBoth);
    REQUIRE(eventually([&] { return worker.status().state == WorkerState::Done; }));
    CHECK(are_measured(worker));
    worker.set_limits({});
    REQUIRE(eventually([&] { return both_rendered(worker, 100); }));
    REQUIRE(rests(worker));
    CHECK(are_measured(worker));
}

// The first pass is interrupted, so that time is charged for no sample: placing volumes takes longer than all passes of the other.
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
    // Usually the first method has one pass, since its placement is slow; on a busy machine the fake passes may be slower.
    CHECK(std::min(done.passes[0], done.passes[1]) >= 1);
    CHECK(std::max(done.passes[0], done.passes[1]) == 8);
}

namespace {

/// Reinforcement on both sides; the second with twice the volumes, and not as the session that it is compared with otherwise.
TurnSides with_more_volumes(const WorkerSetup& setup) {
    auto second = std::make_shared<RenderSettings>(setup.settings);
    second->field.volumes = 32;
    second->width = 5;
    second->seed = 99;
    return {.methods = {MethodId::Reinforcement, MethodId::Reinforcement}, .second = second};
}

std::shared_ptr<const PublishedFrame> frame_of_side(RenderWorker& worker, std::size_t side) {
    std::shared_ptr<const PublishedFrame> frame;
    const bool found = eventually([&] {
        frame = worker.latest();
        return frame && frame->side == side && worker.status().turns;
    });
    return found ? frame : nullptr;
}

}  // namespace

TEST_CASE("Turns on the render thread: one method with other settings is a run of its own, with the same picture") {
    Bench bench;
    bench.control->pass_microseconds = 2000;
    const WorkerSetup setup = bench.setup(MethodId::Reinforcement);
    RenderWorker worker(setup);
    worker.set_turns(with_more_volumes(setup));
    REQUIRE(eventually([&] { return both_rendered(worker, 20); }));
    const auto first = frame_of_side(worker, 0);
    const auto second = frame_of_side(worker, 1);
    REQUIRE((first && second));
    CHECK(first->settings.field.volumes == 16);
    CHECK(second->settings.field.volumes == 32);
    CHECK(second->settings.seed == setup.settings.seed);
    CHECK(second->snapshot.width == kSize);
    CHECK(second->scene == first->scene);
    REQUIRE(eventually([&] { return worker.runs()->runs.size() == 2; }));
    REQUIRE(rests(worker));
    const TurnsStatus turns = *worker.status().turns;
    CHECK_THAT(turns.seconds[0], WithinAbs(turns.seconds[1], 0.6));
    const auto runs = worker.runs()->runs;
    CHECK(runs[0]->label.picture == runs[1]->label.picture);
    CHECK(runs[0]->label.details != runs[1]->label.details);
    CHECK_THAT(runs[0]->label.details + runs[1]->label.details, contains("32 volumes"));
}

TEST_CASE("Turns on the render thread: edits begin both sides anew, and the second keeps its own settings") {
    Bench bench;
    bench.control->pass_microseconds = 500;
    const WorkerSetup setup = bench.setup(MethodId::Reinforcement);
    RenderWorker worker(setup);
    worker.set_turns(with_more_volumes(setup));
    REQUIRE(eventually([&] { return both_rendered(worker, 10); }));
    RenderSettings settings = setup.settings;
    settings.field.volumes = 8;
    const auto shows = [&](std::uint64_t edit, std::size_t side, auto condition) {
        return eventually([&] {
            const auto frame = worker.latest();
            return frame && frame->generation >= edit && frame->side == side && condition(*frame);
        });
    };
    const std::uint64_t moved = worker.submit(EditCamera{camera_at(3.0f)});
    CHECK(shows(moved, 1, [](const PublishedFrame& f) { return f.settings.camera.eye.x == 3.0f; }));
    const std::uint64_t field = worker.submit(EditField{settings.field});
    CHECK(shows(field, 0, [](const PublishedFrame& f) { return f.settings.field.volumes == 8; }));
    CHECK(shows(field, 1, [](const PublishedFrame& f) {
        return f.settings.field.volumes == 32 && f.settings.camera.eye.x == 3.0f;
    }));
    const std::uint64_t deeper = worker.submit(EditEstimator{5, false, RouletteRule::Albedo});
    CHECK(shows(deeper, 1, [&](const PublishedFrame& f) {
        return f.settings.max_depth == 5 && f.settings.roulette == settings.roulette;
    }));
    const std::uint64_t smaller = worker.submit(EditSize{32, 16});
    CHECK(shows(smaller, 1, [](const PublishedFrame& f) { return f.snapshot.width == 32; }));
    const std::uint64_t other_device = worker.switch_backend("cuda");
    CHECK(shows(other_device, 1, [](const PublishedFrame& f) { return f.backend.name == "cuda"; }));
    worker.set_turns(std::nullopt);
    const std::uint64_t back = worker.submit(MethodId::Reinforcement);
    CHECK(shows(back, 0, [](const PublishedFrame& f) { return f.settings.field.volumes == 8; }));
}
