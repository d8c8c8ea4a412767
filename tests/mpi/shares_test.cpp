// Shares of ranks: every pixel once, whatever the blocks and cuts.
#include "mpi/shares.h"

#include <numeric>

#include "tests/support/catch.hpp"

using namespace pl;

namespace {

/// Number of ranks that render each pixel.
std::vector<int> times_rendered(const Shares& shares, int ranks, std::uint32_t pixels) {
    std::vector<int> times(pixels);
    for (int rank = 0; rank < ranks; ++rank)
        for (const IndexRange& range : shares.shares_of(rank))
            for (std::uint32_t i = range.begin; i < range.end; ++i) ++times[i];
    return times;
}

}  // namespace

TEST_CASE("Every pixel of a film belongs to one rank, also with more ranks than pixels") {
    for (const int ranks : {1, 2, 3, 5, 8, 100})
        for (const std::uint32_t pixels : {1u, 7u, 61u * 47u, 300'001u}) {
            Shares shares(ranks);
            shares.cover(pixels / 3);
            shares.cover(pixels);
            CHECK(times_rendered(shares, ranks, pixels) == std::vector<int>(pixels, 1));
            CHECK(shares.share(0, 0).begin == 0);
            CHECK_FALSE(shares.share(0, 0).empty());
            for (std::size_t block = 0; block < shares.blocks(); ++block)
                CHECK(shares.block(block).count() <= Shares::kMostPixels * static_cast<std::uint32_t>(ranks));
        }
}

TEST_CASE("Blocks end where the film was covered first") {
    Shares shares(2);
    shares.cover(1024);
    shares.cover(1024);
    shares.cover(2048);
    shares.cover(1000);
    REQUIRE(shares.blocks() == 2);
    CHECK(shares.block(0) == IndexRange{0, 1024});
    CHECK(shares.block(1) == IndexRange{1024, 2048});
    CHECK(shares.share(1, 1) == IndexRange{1536, 2048});
}

TEST_CASE("A slow share becomes shorter, so that all take the same time") {
    Shares shares(2);
    shares.cover(1000);
    // 1 ms per 100 pixels in the first half, 3 ms in the second one.
    const Shares next = shares.balanced(std::vector<double>{5.0e-3, 15.0e-3});
    CHECK(next.share(0, 0) == IndexRange{0, 664});
    CHECK(next.share(0, 1) == IndexRange{664, 1000});
    CHECK(shares.balanced(std::vector<double>{5.0e-3, 5.1e-3}) == shares);
    CHECK(shares.balanced(std::vector<double>{5.0e-6, 15.0e-6}) == shares);
    const Shares all_first = shares.balanced(std::vector<double>{0.0, 1.0});
    CHECK(times_rendered(all_first, 2, 1000) == std::vector<int>(1000, 1));
}

TEST_CASE("Any times leave every pixel with one rank") {
    std::uint32_t state = 1;
    const auto random = [&] {
        return state = state * 1664525u + 1013904223u, static_cast<double>(state >> 8) * 1.0e-7;
    };
    for (const int ranks : {2, 3, 8}) {
        Shares shares(ranks);
        shares.cover(50);
        shares.cover(4000);
        for (int round = 0; round < 50; ++round) {
            std::vector<double> seconds(shares.blocks() * static_cast<std::size_t>(ranks));
            for (double& value : seconds) value = random();
            shares = shares.balanced(seconds);
            REQUIRE(times_rendered(shares, ranks, 4000) == std::vector<int>(4000, 1));
            REQUIRE_FALSE(shares.share(0, 0).empty());
        }
    }
}

TEST_CASE("No cut divides a block of pixels that variances are measured against") {
    for (const int ranks : {2, 3, 7})
        for (const std::uint32_t pixels : {1000u, 61u * 47u, 300'001u}) {
            Shares shares(ranks);
            shares.cover(pixels);
            std::vector<double> seconds(shares.blocks() * static_cast<std::size_t>(ranks), 1.0);
            seconds.back() = 5.3;
            for (const Shares& made : {shares, shares.balanced(seconds)})
                for (int rank = 0; rank < ranks; ++rank)
                    for (const IndexRange& range : made.shares_of(rank))
                        CHECK(range.begin % VarianceMeasure::kBlock == 0);
        }
}
