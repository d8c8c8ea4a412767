#include "cuda/kernels/scattered_pixels.h"

#include <algorithm>
#include <vector>

#include "tests/support/catch.hpp"

using pl::cuda::scattered_number;

namespace {

constexpr std::uint32_t kLanes = 32;

/// The warp of each item. Fails unless every item has one thread, and threads without an item say so.
std::vector<std::uint32_t> warps_of(std::uint32_t lanes, std::uint32_t count) {
    constexpr std::uint32_t kNone = 0xffffffffu;
    std::vector<std::uint32_t> warps(count, kNone);
    bool is_unique = true;
    for (std::uint32_t thread = 0; thread < count + 4 * kLanes; ++thread) {
        const std::uint32_t number = scattered_number(thread, lanes, count);
        if (number >= count) continue;
        is_unique = is_unique && warps[number] == kNone;
        warps[number] = thread / lanes;
    }
    CHECK(is_unique);
    CHECK(std::ranges::count(warps, kNone) == 0);
    return warps;
}

/// Most items of a warp among the items of a line.
std::uint32_t most_of_a_warp(const std::vector<std::uint32_t>& warps, std::uint32_t length, auto&& item_of) {
    std::vector<std::uint32_t> counts(warps.size());
    for (std::uint32_t i = 0; i < length; ++i) ++counts[warps[item_of(i)]];
    return *std::ranges::max_element(counts);
}

}  // namespace

TEST_CASE("Scattered numbers give every item to one thread") {
    for (const std::uint32_t lanes : {1u, kLanes})
        for (const std::uint32_t count : {1u, 31u, 32u, 33u, 1000u, 512u * 512u, 1280u * 720u})
            (void)warps_of(lanes, count);
}

TEST_CASE("No warp has two pixels of a straight border in a picture") {
    struct Size {
        std::uint32_t width, height;
    };
    for (const Size size : {Size{512, 512}, Size{640, 360}, Size{1280, 720}, Size{1920, 1080}}) {
        CAPTURE(size.width, size.height);
        const std::vector<std::uint32_t> warps = warps_of(kLanes, size.width * size.height);
        const auto most = [&](std::uint32_t length, auto&& item_of) {
            return most_of_a_warp(warps, length, item_of);
        };
        CHECK(most(size.width, [&](std::uint32_t x) { return size.height / 2 * size.width + x; }) == 1);
        CHECK(most(size.height, [&](std::uint32_t y) { return y * size.width + size.width / 2; }) == 1);
        CHECK(most(size.width, [&](std::uint32_t x) { return x * size.height / size.width * size.width + x; }) == 1);
    }
}
