// The self test in the background: its checks one by one, its outcome, its end.
// The self test in the window: rendering rests while it runs, and Esc ends it.
#include "ui/model/self_test.h"

#include <condition_variable>

#include "core/base/error.h"
#include "tests/support/catch.hpp"
#include "tests/ui/fake_backend.h"
#include "tests/ui/model_bench.h"
#include "ui/script/script_values.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

/// Three checks, each of which waits until it is allowed.
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

void run_all(SelfTestRun& run, CheckQueue& queue) {
    run.start(queue.runner());
    queue.allow(3);
    REQUIRE(eventually([&] { return run.update(); }));
    const std::lock_guard lock(queue.mutex);
    queue.allowed = 0;
}

}  // namespace

TEST_CASE("Self test run: checks arrive one by one") {
    CheckQueue queue;
    SelfTestRun run;
    CHECK(run.outcome() == SelfTestRun::Outcome::None);
    run.start(queue.runner());
    queue.allow(1);
    REQUIRE(eventually([&] {
        run.update();
        return run.checks().size() == 1;
    }));
    CHECK(run.outcome() == SelfTestRun::Outcome::Running);
    CHECK(run.summary() == "1 check so far, 0 failed");
    queue.allow(2);
    REQUIRE(eventually([&] { return run.update(); }));
    CHECK_FALSE(run.is_running());
    CHECK(run.outcome() == SelfTestRun::Outcome::Passed);
    CHECK(run.summary() == "all 3 checks passed in 0.0 s on cpu, cuda");
}

TEST_CASE("Self test run: one that is stopped, that fails and that breaks off says so, and can be run again") {
    CheckQueue queue;
    SelfTestRun run;
    run.start(queue.runner());
    queue.allow(1);
    REQUIRE(eventually([&] {
        run.update();
        return run.checks().size() == 1;
    }));
    run.stop();
    REQUIRE(eventually([&] { return run.update(); }));
    CHECK(run.outcome() == SelfTestRun::Outcome::Stopped);
    CHECK(run.summary() == "ended after 1 check, without a failure");
    queue.fails = true;
    run_all(run, queue);
    CHECK(run.outcome() == SelfTestRun::Outcome::Failed);
    CHECK(run.summary().starts_with("1 of 3 checks failed"));
    queue.fails = false;
    queue.breaks = true;
    run_all(run, queue);
    CHECK(run.outcome() == SelfTestRun::Outcome::Broken);
    CHECK(run.summary() == "stopped by an error after 1 check: the device is lost");
    CHECK(run.checks().size() == 1);
}

TEST_CASE("Self test: rendering rests while it runs, and Esc ends it") {
    ModelBench bench(16);
    bench.options.backends = {{"cpu", "", ""}, {"cuda", "", "there is none"}};
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.frame() != nullptr; }));
    model.self_test().start();
    CHECK(model.self_test().is_shown());
    CHECK(script_value(model, "selftest") == "running");
    CHECK(model.busy());
    REQUIRE(bench.run_until(model, [&] {
        return !model.self_test().run().checks().empty() && model.status().state == WorkerState::Paused;
    }));
    CHECK(model.self_test().run().checks()[0].backend == "cpu");
    model.cancel();
    REQUIRE(bench.run_until(model, [&] { return !model.self_test().run().is_running(); }));
    // The fake back end paints one value, which no closed form matches.
    CHECK(model.self_test().run().outcome() == SelfTestRun::Outcome::Failed);
    CHECK(told(model, "self test: "));
    REQUIRE(bench.run_until(model, [&] { return model.status().state == WorkerState::Rendering; }));
    model.cancel();
    CHECK_FALSE(model.self_test().is_shown());
}

TEST_CASE("Self test: closing the viewer ends a self test and a search") {
    ModelBench bench(16);
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    model.self_test().start();
    model.diagnostics().toggle();
    model.update(0.0);
}
