// What the window tells of diagnostics: counted, looked for in the background, shown while the picture stands; the self test.
#include <algorithm>
#include <condition_variable>

#include "core/base/error.h"
#include "tests/support/catch.hpp"
#include "tests/ui/model_bench.h"
#include "ui/script_values.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr int kSide = 16;
constexpr int kBad = 37;

bool told(const ViewerModel& model, const std::string& part) {
    return std::any_of(model.log().begin(), model.log().end(),
                       [&](const LogLine& line) { return line.text.find(part) != std::string::npos; });
}

/// A viewer of a picture in which one pixel has only invalid samples.
struct DiagnosticsBench : ModelBench {
    DiagnosticsBench() : ModelBench(kSide) {
        devices.cpu->bad_pixel = kBad;
        options.limits.spp = 4;
    }
    bool is_done(ViewerModel& model) {
        return run_until(model, [&] {
            return model.frame() != nullptr && model.frame()->snapshot.passes == 4 &&
                   model.status().state == WorkerState::Done;
        });
    }
};

/// A self test whose checks come when the test says so.
struct CheckQueue {
    std::mutex mutex;
    std::condition_variable wake;
    int allowed = 0;
    bool fails = false;
    bool breaks = false;

    void allow(int count) {
        const std::lock_guard lock(mutex);
        allowed += count;
        wake.notify_all();
    }
    auto runner() {
        return [this](const JobMonitor& monitor, const std::function<void(const SelfCheck&)>& told) {
            for (int i = 0; i < 3; ++i) {
                std::unique_lock lock(mutex);
                while (allowed == 0 && !*monitor.stop) wake.wait_for(lock, std::chrono::milliseconds(1));
                if (*monitor.stop) return;
                --allowed;
                if (breaks && i == 1) throw Error(ErrorKind::Runtime, "the device is lost");
                SelfCheck check{.backend = i < 2 ? "cpu" : "cuda", .name = "check", .criterion = "it holds"};
                check.passed = !(fails && i == 1);
                told(check);
            }
        };
    }
};

}  // namespace

TEST_CASE(
    "Window: invalid samples are counted in the frame, found where they were, and marked until the picture changes") {
    DiagnosticsBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.is_done(model));
    CHECK(counted_diagnostics(model.frame()->snapshot) == DiagnosticCounts{4, 0, 0, 0});
    CHECK(script_value(model, "diagnostics") == "not looked for");

    model.toggle_diagnostics();
    CHECK(model.busy());
    REQUIRE(bench.run_until(model, [&] { return model.diagnostics() != nullptr; }));
    const auto map = model.diagnostics();
    CHECK(map->is_complete);
    CHECK(map->pixels[kBad] == DiagnosticsMap::Pixel{4, 0, 0, 0});
    CHECK(map->pixel_count(Diagnostic::Invalid) == 1);
    CHECK(script_value(model, "diagnostics") == "4 invalid in 1 pixel");
    CHECK(told(model, "4 invalid in 1 pixel"));
    CHECK_FALSE(model.busy());

    model.toggle_diagnostics();
    CHECK(model.diagnostics() == nullptr);
    model.toggle_diagnostics();
    REQUIRE(bench.run_until(model, [&] { return model.diagnostics() != nullptr; }));
    model.set_seed(2);
    REQUIRE(bench.run_until(model, [&] { return model.diagnostics() == nullptr; }));
    REQUIRE(bench.is_done(model));
    CHECK(model.diagnostics() == nullptr);
}

TEST_CASE("Window: Esc ends the marks, and a picture that goes on does not") {
    DiagnosticsBench bench;
    bench.options.limits.spp = 0;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.frame() != nullptr; }));
    model.toggle_diagnostics();
    REQUIRE(bench.run_until(model, [&] { return model.diagnostics() != nullptr; }));
    const std::uint32_t passes = model.frame()->snapshot.passes;
    REQUIRE(bench.run_until(model, [&] { return model.frame()->snapshot.passes > passes + 2; }));
    CHECK(model.diagnostics() != nullptr);
    model.cancel();
    CHECK(model.diagnostics() == nullptr);
}

TEST_CASE("Window: a view without paths says so, and rendering goes on") {
    DiagnosticsBench bench;
    bench.options.limits.spp = 0;
    bench.options.settings.view = View::Normal;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.frame() != nullptr; }));
    model.toggle_diagnostics();
    REQUIRE(bench.run_until(model, [&] { return told(model, "view 'normal' has no paths"); }));
    CHECK_FALSE(model.busy());
    CHECK(model.diagnostics() == nullptr);
    REQUIRE(bench.run_until(model, [&] { return model.status().state == WorkerState::Rendering; }));
}

TEST_CASE("Window: a device that is lost while diagnostics is looked for is told, and holds nothing up") {
    DiagnosticsBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.is_done(model));
    bench.devices.cpu->lost = true;
    model.toggle_diagnostics();
    REQUIRE(bench.run_until(model, [&] { return told(model, "the device is lost"); }));
    CHECK_FALSE(model.busy());
    CHECK(model.diagnostics() == nullptr);
}

TEST_CASE("Window: nothing is found where nothing went wrong") {
    DiagnosticsBench bench;
    bench.devices.cpu->bad_pixel = -1;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.is_done(model));
    model.toggle_diagnostics();
    REQUIRE(bench.run_until(model, [&] { return model.diagnostics() != nullptr; }));
    CHECK(script_value(model, "diagnostics") == "no diagnostics found");
}

TEST_CASE("Window: the self test tells check by check, and rendering rests meanwhile") {
    ModelBench bench(kSide);
    CheckQueue queue;
    bench.options.run_self_test = queue.runner();
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.frame() != nullptr; }));
    model.start_self_test();
    CHECK(model.window().self_test);
    queue.allow(1);
    REQUIRE(bench.run_until(model, [&] { return model.self_test().checks().size() == 1; }));
    REQUIRE(bench.run_until(model, [&] { return model.status().state == WorkerState::Paused; }));
    CHECK(script_value(model, "selftest") == "running");
    CHECK(model.busy());
    queue.allow(2);
    REQUIRE(bench.run_until(model, [&] { return !model.self_test().is_running(); }));
    CHECK(model.self_test().outcome() == SelfTestRun::Outcome::Passed);
    CHECK(model.self_test().summary() == "all 3 checks passed in 0.0 s on cpu, cuda");
    REQUIRE(bench.run_until(model, [&] { return model.status().state == WorkerState::Rendering; }));
    model.cancel();
    CHECK_FALSE(model.window().self_test);
}

TEST_CASE("Window: a self test is ended by Esc, run again, and tells what failed and what broke") {
    ModelBench bench(kSide);
    CheckQueue queue;
    bench.options.run_self_test = queue.runner();
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    const auto run = [&] {
        model.start_self_test();
        queue.allow(3);
        REQUIRE(bench.run_until(model, [&] { return !model.self_test().is_running(); }));
        const std::lock_guard lock(queue.mutex);
        queue.allowed = 0;
    };
    model.start_self_test();
    queue.allow(1);
    REQUIRE(bench.run_until(model, [&] { return model.self_test().checks().size() == 1; }));
    model.cancel();
    REQUIRE(bench.run_until(model, [&] { return !model.self_test().is_running(); }));
    CHECK(model.self_test().summary() == "ended after 1 check, without a failure");
    queue.fails = true;
    run();
    CHECK(model.self_test().outcome() == SelfTestRun::Outcome::Failed);
    CHECK(told(model, "self test: 1 of 3 checks failed"));
    queue.fails = false;
    queue.breaks = true;
    run();
    CHECK(model.self_test().outcome() == SelfTestRun::Outcome::Broken);
    CHECK(told(model, "broke off after 1 check: the device is lost"));
    CHECK(model.self_test().checks().size() == 1);
}

TEST_CASE("Window: closing it ends a self test and a search") {
    ModelBench bench(kSide);
    CheckQueue queue;
    bench.options.run_self_test = queue.runner();
    {
        ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
        model.start_self_test();
        model.toggle_diagnostics();
        model.update(0.0);
    }
    CHECK(queue.allowed == 0);
    {
        bench.options.run_self_test = {};
        ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
        model.start_self_test();
        CHECK(told(model, "this build has no self test"));
    }
}
