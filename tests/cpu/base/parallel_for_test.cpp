// The queue returns every number once and stops on request; exceptions of any thread are rethrown.
#include <stdexcept>
#include <vector>

#include "cpu/base/parallel_for.h"
#include "tests/support/catch.hpp"

using namespace pl;

TEST_CASE("A queue hands out every number once, in ascending chunks") {
    for (const std::uint32_t chunk : {1u, 7u, 256u, 5000u}) {
        ChunkQueue queue(13, 1013, chunk);
        std::uint32_t next = 13;
        for (IndexRange range = queue.claim(); !range.empty(); range = queue.claim()) {
            REQUIRE(range.begin == next);
            REQUIRE(range.end - range.begin <= chunk);
            next = range.end;
        }
        CHECK(next == 1013);
        CHECK(queue.claim().empty());
    }
}

TEST_CASE("A queue that reaches the last 32-bit number ends") {
    ChunkQueue queue(0xfffffff0u, 0xffffffffu, 0x80000000u);
    const IndexRange last = queue.claim();
    CHECK(last.begin == 0xfffffff0u);
    CHECK(last.end == 0xffffffffu);
    for (int i = 0; i < 8; ++i) CHECK(queue.claim().empty());
}

TEST_CASE("A queue of nothing hands out nothing") {
    CHECK(ChunkQueue(0, 0, 16).claim().empty());
    CHECK(ChunkQueue(20, 20, 16).claim().empty());
    CHECK(ChunkQueue(30, 20, 16).claim().empty());
}

TEST_CASE("A queue hands out nothing after the stop flag") {
    std::atomic<bool> stop{false};
    ChunkQueue queue(0, 100, 10, &stop);
    CHECK(queue.claim().end == 10);
    stop = true;
    CHECK(queue.claim().empty());
}

TEST_CASE("Threads together see every index once") {
    for (const int threads : {1, 2, 7}) {
        std::vector<std::atomic<int>> seen(10007);
        ChunkQueue queue(0, 10007, 16);
        parallel_for(threads, queue, [&](IndexRange range) {
            for (std::uint32_t i = range.begin; i < range.end; ++i) seen[i].fetch_add(1, std::memory_order_relaxed);
        });
        for (const std::atomic<int>& count : seen) REQUIRE(count == 1);
    }
}

TEST_CASE("Threads are numbered below the requested number") {
    std::atomic<int> highest{-1};
    std::atomic<int> calls{0};
    run_on_threads(7, [&](int thread) {
        ++calls;
        for (int before = highest; before < thread && !highest.compare_exchange_weak(before, thread);) {
        }
    });
    CHECK(calls >= 1);
    CHECK(highest == calls - 1);
    CHECK(highest < 7);
}

TEST_CASE("The first error of a thread comes back when all have ended") {
    std::atomic<int> ended{0};
    CHECK_THROWS_AS(run_on_threads(3,
                                   [&](int) {
                                       ++ended;
                                       throw std::length_error("no room");
                                   }),
                    std::length_error);
    CHECK(ended >= 1);
}
