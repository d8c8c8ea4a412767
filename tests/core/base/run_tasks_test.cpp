#include "core/base/run_tasks.h"

#include <atomic>
#include <stdexcept>

#include "tests/support/catch.hpp"

using namespace pl;

TEST_CASE("Every task is run once, however many find others") {
    for (const int threads : {1, 2, 5}) {
        std::vector<std::atomic<int>> runs(2047);
        run_tasks(std::size_t{0}, threads, [&](std::size_t task, auto&& push) {
            ++runs[task];
            for (const std::size_t next : {2 * task + 1, 2 * task + 2})
                if (next < runs.size()) push(next);
        });
        for (const std::atomic<int>& count : runs) REQUIRE(count == 1);
    }
}

TEST_CASE("A task that throws ends the run, with its exception") {
    for (const int threads : {1, 2, 5}) {
        std::atomic<int> runs{0};
        const auto body = [&](int task, auto&& push) {
            ++runs;
            if (task == 50) throw std::runtime_error("the fiftieth");
            push(task + 1);
        };
        CHECK_THROWS_WITH(run_tasks(0, threads, body), "the fiftieth");
        CHECK(runs == 51);
    }
}
