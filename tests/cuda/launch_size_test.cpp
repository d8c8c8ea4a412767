#include "cuda/launch_size.h"

#include <algorithm>

#include "tests/support/catch.hpp"

using pl::cuda::LaunchSize;

namespace {

/// Simulates launches on a device that traces `paths_per_ms` paths per millisecond, until the size converges.
LaunchSize settled(float paths_per_ms) {
    LaunchSize size;
    for (int i = 0; i < 50; ++i) {
        const std::uint32_t paths = size.next(0xffffffffu);
        size.observe(paths, static_cast<float>(paths) / paths_per_ms, 1.0f);
    }
    return size;
}

}  // namespace

TEST_CASE("Launches come to last the time that was aimed at") {
    for (const float speed : {1.0e4f, 1.0e5f, 1.0e6f}) {
        const auto milliseconds = static_cast<float>(settled(speed).next(0xffffffffu)) / speed;
        CHECK(milliseconds == Approx(LaunchSize::kTargetMilliseconds).epsilon(0.01));
    }
    CHECK(settled(1.0f).next(0xffffffffu) == LaunchSize::kLeast);
    CHECK(settled(1.0e12f).next(0xffffffffu) == LaunchSize::kMost);
}

TEST_CASE("A rest is taken along, and never more than there is") {
    const LaunchSize size;
    CHECK(size.next(7) == 7);
    CHECK(size.next(LaunchSize::kFirst + LaunchSize::kFirst / 2 - 1) ==
          LaunchSize::kFirst + LaunchSize::kFirst / 2 - 1);
    CHECK(size.next(LaunchSize::kFirst * 2) == LaunchSize::kFirst);
    CHECK(size.next(0) == 0);
}

TEST_CASE("One odd measurement changes little, and small launches teach nothing") {
    LaunchSize size = settled(1.0e5f);
    const std::uint32_t before = size.next(0xffffffffu);
    size.observe(before, 1.0e9f, 1.0f);
    CHECK(size.next(0xffffffffu) >= before / 4 - 1);
    size = settled(1.0e5f);
    size.observe(before, 0.0f, 1.0f);
    CHECK(size.next(0xffffffffu) <= before * 4 + 1);
    size = settled(1.0e5f);
    size.observe(100, 50.0f, 1.0f);
    CHECK(size.next(0xffffffffu) == before);
}

TEST_CASE("A launch that waits for one long path grows until its other paths take the time that was aimed at") {
    constexpr float kWait = 5.0f;     // milliseconds of the thread with the long path
    constexpr float kSpeed = 1.0e5f;  // paths per millisecond
    LaunchSize size;
    for (int i = 0; i < 50; ++i) {
        const std::uint32_t paths = size.next(0xffffffffu);
        const float even = static_cast<float>(paths) / kSpeed;
        const float all = std::max(even, kWait);
        size.observe(paths, all, even / all);
    }
    const float milliseconds = static_cast<float>(size.next(0xffffffffu)) / kSpeed;
    CHECK(milliseconds == Approx(LaunchSize::kTargetMilliseconds).epsilon(0.01));
}

TEST_CASE("Small pictures have several passes in a launch, large ones one") {
    const LaunchSize size;
    CHECK(size.passes(LaunchSize::kFirst / 8, 100) == 8);
    CHECK(size.passes(LaunchSize::kFirst / 8, 3) == 3);
    CHECK(size.passes(LaunchSize::kFirst + 1, 100) == 1);
    CHECK(size.passes(0, 0) == 1);
}
