#include "ui/worker/motion_resolution.h"

#include "tests/support/catch.hpp"

using namespace pl;
using namespace pl::ui;

TEST_CASE("Motion resolution: takes the finest size that keeps the rate, and does not flicker") {
    constexpr double kTarget = MotionResolution::kTargetSeconds;
    MotionResolution motion;
    motion.observe(1,
                   8.0 * kTarget);  // a quarter of the width costs half the target, half the width twice of it
    CHECK(motion.divider() == 4);
    motion.observe(4, 0.5 * kTarget);
    CHECK(motion.divider() == 4);
    motion.observe(4, 1.1 * kTarget);  // within the dead band
    CHECK(motion.divider() == 4);
    motion.observe(4, 1.3 * kTarget);
    CHECK(motion.divider() == 8);
    motion.observe(8, 0.325 * kTarget);  // the finer size would miss the target again: stay
    CHECK(motion.divider() == 8);
    motion.observe(8, 0.19 * kTarget);
    CHECK(motion.divider() == 4);
    motion.observe(4, 0.01 * kTarget);
    CHECK(motion.divider() == 1);
    motion.observe(1, 1.0e9);
    CHECK(motion.divider() == MotionResolution::kMaxDivider);
    motion.observe(8, -1.0);
    CHECK(motion.divider() == MotionResolution::kMaxDivider);
}

TEST_CASE("Motion resolution: small pictures are not divided beyond recognition") {
    MotionResolution motion;
    motion.observe(1, 100.0);
    CHECK(motion.divider() == 8);
    CHECK(motion.divider_for(1280, 720) == 8);
    CHECK(motion.divider_for(512, 512) == 4);
    CHECK(motion.divider_for(200, 300) == 2);
    CHECK(motion.divider_for(64, 64) == 1);
    CHECK(divided(721, 4) == 180);
    CHECK(divided(3, 8) == 1);
}
