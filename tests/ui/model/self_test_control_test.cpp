// The self test in the window: run, ended, failed, and broken by an error.
#include <condition_variable>

#include "core/base/error.h"
#include "tests/support/catch.hpp"
#include "tests/ui/model_bench.h"
#include "ui/script/script_values.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr int kSide = 16;

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

TEST_CASE("Self test: checks arrive one by one, and rendering rests meanwhile") {
    ModelBench bench(kSide);
    CheckQueue queue;
    bench.options.run_self_test = queue.runner();
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.frame() != nullptr; }));
    model.self_test().start();
    CHECK(model.self_test().is_shown());
    queue.allow(1);
    REQUIRE(bench.run_until(model, [&] { return model.self_test().run().checks().size() == 1; }));
    REQUIRE(bench.run_until(model, [&] { return model.status().state == WorkerState::Paused; }));
    CHECK(script_value(model, "selftest") == "running");
    CHECK(model.busy());
    queue.allow(2);
    REQUIRE(bench.run_until(model, [&] { return !model.self_test().run().is_running(); }));
    CHECK(model.self_test().run().outcome() == SelfTestRun::Outcome::Passed);
    CHECK(model.self_test().run().summary() == "all 3 checks passed in 0.0 s on cpu, cuda");
    REQUIRE(bench.run_until(model, [&] { return model.status().state == WorkerState::Rendering; }));
    model.cancel();
    CHECK_FALSE(model.self_test().is_shown());
}

TEST_CASE("Self test: ended by Esc, run again, failed, and stopped by an error") {
    ModelBench bench(kSide);
    CheckQueue queue;
    bench.options.run_self_test = queue.runner();
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    const auto run = [&] {
        model.self_test().start();
        queue.allow(3);
        REQUIRE(bench.run_until(model, [&] { return !model.self_test().run().is_running(); }));
        const std::lock_guard lock(queue.mutex);
        queue.allowed = 0;
    };
    model.self_test().start();
    queue.allow(1);
    REQUIRE(bench.run_until(model, [&] { return model.self_test().run().checks().size() == 1; }));
    model.cancel();
    REQUIRE(bench.run_until(model, [&] { return !model.self_test().run().is_running(); }));
    CHECK(model.self_test().run().summary() == "ended after 1 check, without a failure");
    queue.fails = true;
    run();
    CHECK(model.self_test().run().outcome() == SelfTestRun::Outcome::Failed);
    CHECK(told(model, "self test: 1 of 3 checks failed"));
    queue.fails = false;
    queue.breaks = true;
    run();
    CHECK(model.self_test().run().outcome() == SelfTestRun::Outcome::Broken);
    CHECK(told(model, "stopped by an error after 1 check: the device is lost"));
    CHECK(model.self_test().run().checks().size() == 1);
}

TEST_CASE("Self test: closing the viewer ends a self test and a search") {
    ModelBench bench(kSide);
    CheckQueue queue;
    bench.options.run_self_test = queue.runner();
    {
        ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
        model.self_test().start();
        model.diagnostics().toggle();
        model.update(0.0);
    }
    CHECK(queue.allowed == 0);
    {
        bench.options.run_self_test = {};
        ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
        model.self_test().start();
        CHECK(told(model, "this build has no self test"));
    }
}
