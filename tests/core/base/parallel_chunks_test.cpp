#include "core/base/parallel_chunks.h"

#include <stdexcept>

#include "tests/support/catch.hpp"

using namespace pl;

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
