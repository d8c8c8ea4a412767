#include "ui/worker/inspection.h"

#include <thread>

#include "tests/support/catch.hpp"
#include "tests/ui/worker/session_bench.h"
#include "tests/ui/worker_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Inspection: is read once for a volume, again after edits, and at intervals") {
    SessionBench bench;
    bench.render(kLearning, 1);
    Inspection inspection;
    CHECK_FALSE(inspection.wants(kNoVolume));
    CHECK_FALSE(inspection.refresh(bench.session, kLearning.method, kNoVolume));
    CHECK(inspection.wants(1));
    REQUIRE(inspection.refresh(bench.session, kLearning.method, 1));
    CHECK(inspection.shown() == 1);
    CHECK(inspection.volume()->side == 4);
    CHECK_FALSE(inspection.refresh(bench.session, kLearning.method, 1));
    inspection.invalidate();
    CHECK(inspection.wants(1));
    CHECK(inspection.refresh(bench.session, kLearning.method, 1));
    const auto before = inspection.volume();
    CHECK(eventually([&] { return inspection.refresh(bench.session, kLearning.method, 1); }));
    CHECK(inspection.volume() != before);
    CHECK(inspection.refresh(bench.session, kLearning.method, kNoVolume));
    CHECK_FALSE(inspection.volume());
}

TEST_CASE("Render worker: picks a surface and inspects its volume, also while paused") {
    Bench bench;
    RenderWorker worker(bench.setup(MethodId::Reinforcement));
    REQUIRE(frame_of(worker, 0));
    worker.set_paused(true);
    worker.request_pick({0.5f, 0.65f});
    std::optional<PickAnswer> answer;
    REQUIRE(eventually([&] { return (answer = worker.take<PickAnswer>()).has_value(); }));
    REQUIRE(answer->value);
    CHECK_THAT(answer->value->position.y, WithinAbs(0.0f, 1.0e-3f));
    REQUIRE(answer->value->volume != kNoVolume);
    CHECK_FALSE(worker.take<PickAnswer>());

    worker.select_volume(answer->value->volume);
    REQUIRE(eventually([&] { return worker.latest()->volume != nullptr; }));
    CHECK(worker.latest()->volume->volume == answer->value->volume);
    CHECK(worker.latest()->volume->side == 4);
    worker.select_volume(kNoVolume);
    CHECK(eventually([&] { return worker.latest()->volume == nullptr; }));

    worker.request_pick({0.01f, 0.01f});
    REQUIRE(eventually([&] { return (answer = worker.take<PickAnswer>()).has_value(); }));
    CHECK_FALSE(answer->value);
}

TEST_CASE("Render worker: a selected volume without tables is no error") {
    Bench bench;
    RenderWorker worker(bench.setup(MethodId::Default));
    REQUIRE(frame_of(worker, 0));
    worker.select_volume(2);
    REQUIRE(eventually([&] { return worker.latest()->volume != nullptr; }));
    CHECK(worker.latest()->volume->side == 0);
    CHECK(worker.take_messages().empty());
}

TEST_CASE("Render worker: a selected volume is shown before the pass under way ends") {
    Bench bench;
    RenderWorker worker(bench.setup(MethodId::Reinforcement));
    REQUIRE(frame_of(worker, 0));
    bench.control->hold = true;
    REQUIRE(eventually([&] { return bench.control->inside.load(); }));
    worker.select_volume(2);
    CHECK(eventually([&] {
        const auto frame = worker.latest();
        return frame->volume && frame->volume->volume == 2;
    }));
    bench.control->hold = false;
}
