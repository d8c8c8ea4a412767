#include "ui/worker/frame_schedule.h"

#include "tests/support/catch.hpp"
#include "tests/ui/worker_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Frame schedule: a frame is due when the film has another pass and the interval is over") {
    FrameSchedule frames;
    CHECK_FALSE(frames.is_due(0, false, 0.0));
    CHECK(frames.is_due(1, false, 0.0));
    frames.end(1);
    CHECK(frames.shows(1));
    CHECK_FALSE(frames.is_due(1, true, 0.0));
    CHECK(frames.is_due(2, true, 0.0));  // a moving camera waits for no interval
    CHECK(eventually([&] { return frames.is_due(2, false, 0.0); }));
    frames.change_film();
    CHECK_FALSE(frames.shows(1));
    CHECK(frame_interval(1.0) < frame_interval(5.0));
    CHECK(frame_interval(5.0) < frame_interval(20.0));
}

TEST_CASE("Frame schedule: another display and missing values make a frame stale, superfluous values do not") {
    FrameSchedule frames;
    Requests now;
    CHECK_FALSE(frames.is_stale(now));
    now.display.exposure_ev = 1.0f;
    now.values = true;
    CHECK(frames.is_stale(now));
    frames.settle(now);
    CHECK_FALSE(frames.is_stale(now));
    now.values = false;
    CHECK_FALSE(frames.is_stale(now));
    frames.ask();
    CHECK(frames.is_asked());
    frames.begin();
    CHECK_FALSE(frames.is_asked());
}

TEST_CASE("Render worker: exposure and curve show at once, paused, done or in the middle of a pass") {
    const DisplaySettings darker{.exposure_ev = -3.0f, .curve = ToneCurve::Reinhard};
    const DisplaySettings darkest{.exposure_ev = -5.0f, .curve = ToneCurve::Aces};
    const auto shows = [](RenderWorker& worker, const DisplaySettings& display) {
        return eventually([&] {
            const auto frame = worker.latest();
            return frame && frame->display == display &&
                   frame->picture.pixels()[5] == gray_pixel(frame->snapshot.camera.eye.x, display);
        });
    };
    Bench bench;
    WorkerSetup setup = bench.setup(MethodId::Default, {.spp = 4, .seconds = 0.0});
    setup.settings.camera = camera_at(2.0f);
    setup.display = darker;
    RenderWorker worker(std::move(setup));
    REQUIRE(eventually([&] { return worker.status().state == WorkerState::Done; }));
    CHECK(shows(worker, darker));
    worker.set_display(darkest);
    CHECK(shows(worker, darkest));
    CHECK(worker.status().passes == 4);
    REQUIRE(rests(worker));
    worker.set_display(darker);
    CHECK(shows(worker, darker));
    CHECK(bench.control->passes == 4);

    bench.control->hold = true;
    worker.set_limits({});
    worker.set_paused(false);
    REQUIRE(eventually([&] { return bench.control->inside.load(); }));
    worker.set_display(darkest);
    CHECK(shows(worker, darkest));
    CHECK(worker.status().passes == 4);
    CHECK(bench.control->stopped == 1);
    bench.control->hold = false;
    CHECK(eventually([&] { return worker.status().passes >= 6; }));  // the pass continues
}

TEST_CASE("Render worker: an exposure set before the first picture does not keep it from coming") {
    Bench bench;
    bench.control->hold = true;
    RenderWorker worker(bench.setup());
    REQUIRE(eventually([&] { return bench.control->inside.load(); }));
    worker.set_display({.exposure_ev = 2.0f});
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK(bench.control->stopped == 0);
    bench.control->hold = false;
    const auto frame = frame_of(worker, 0);
    REQUIRE(frame);
    CHECK(eventually([&] { return worker.latest()->display.exposure_ev == 2.0f; }));
}

TEST_CASE("Render worker: values of the film come when they are wanted, also while paused") {
    Bench bench;
    RenderWorker worker(bench.setup());
    REQUIRE(frame_of(worker, 0));
    REQUIRE(rests(worker));
    REQUIRE_FALSE(worker.latest()->has_values());
    worker.set_values_wanted(true);
    REQUIRE(eventually([&] { return worker.latest()->has_values(); }));
    CHECK(worker.latest()->snapshot.pixels.size() == std::size_t{kSize} * kSize);
    worker.set_values_wanted(false);
    worker.set_paused(false);
    CHECK(eventually([&] { return !worker.latest()->has_values(); }));
}

TEST_CASE("Render worker: a frame that cannot be made is reported once") {
    Bench bench;
    RenderWorker worker(bench.setup(MethodId::Reinforcement));
    REQUIRE(frame_of(worker, 0));
    worker.select_volume(0);
    REQUIRE(rests(worker));
    worker.take_messages();
    bench.control->lost = true;
    worker.set_display({.exposure_ev = 1.0f});
    REQUIRE(eventually([&] { return worker.status().state == WorkerState::Failed; }));
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    CHECK(worker.take_messages().size() == 1);
    worker.set_values_wanted(true);
    REQUIRE(eventually([&] { return worker.take_messages().size() == 1; }));
    bench.control->lost = false;
    worker.submit(EditRestart{});
    CHECK(eventually([&] { return worker.latest()->display.exposure_ev == 1.0f && worker.latest()->has_values(); }));
}
