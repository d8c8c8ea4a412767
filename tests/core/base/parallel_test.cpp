#include "core/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <thread>

#include "tests/support/catch.hpp"

using namespace pl;

TEST_CASE("A quota of processor time is so many processors, rounded up") {
    CHECK(processors_of_quota("1600000 100000") == 16);
    CHECK(processors_of_quota("150000 100000") == 2);
    CHECK(processors_of_quota("1 100000") == 1);
    CHECK(processors_of_quota("9223372036854775807 1") == 2147483647);
}

TEST_CASE("Without a quota there is no limit") {
    for (const char* text : {"max 100000", "-1 100000", "0 100000", "100000 0", "", " ", "100000", "100000 ",
                             "100000 x", "100000 100000 1", "1e5 100000", "99999999999999999999 100000"}) {
        INFO(text);
        CHECK_FALSE(processors_of_quota(text));
    }
}

TEST_CASE("At least one thread runs here, and no more than there are processors") {
    CHECK(usable_threads() >= 1);
    CHECK(usable_threads() <= std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
}

TEST_CASE("Chunks cover every index once") {
    for (const std::uint32_t count : {0u, 1u, 7u, 8u, 9u, 1000u})
        for (const int threads : {1, 2, 5}) {
            std::vector<int> visits(count);
            for_chunks(count, 8, threads, [&](IndexRange range) {
                CHECK(range.begin % 8 == 0);
                for (std::uint32_t i = range.begin; i < range.end; ++i) ++visits[i];
            });
            CHECK(visits == std::vector<int>(count, 1));
        }
}

TEST_CASE("An exception of a chunk reaches the caller") {
    const auto fail_at_twenty = [](IndexRange range) {
        if (range.begin == 20) throw std::runtime_error("twenty");
    };
    for (const int threads : {1, 3}) CHECK_THROWS_WITH(for_chunks(100, 10, threads, fail_at_twenty), "twenty");
}

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
