#include "ui/worker/picture_size.h"

#include "tests/support/catch.hpp"
#include "tests/ui/worker/session_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Picture size: coarse in motion, whole at rest, and only a change empties films") {
    SessionBench bench(512);
    PictureSize size(512, 512);
    CHECK_FALSE(size.apply(bench.session, false));
    CHECK(size.is_whole());
    size.observe(1.0);  // far above the time of a frame
    CHECK(size.apply(bench.session, true));
    CHECK(size.divider() == 4);  // no side below MotionResolution::kMinLongSide
    CHECK(bench.session.settings().width == 128);
    CHECK_FALSE(size.apply(bench.session, true));
    CHECK(size.apply(bench.session, false));
    CHECK(bench.session.settings().height == 512);
    size.resize(300, 200);
    CHECK_FALSE(size.is_whole());
    CHECK(size.apply(bench.session, false));
    CHECK(size.is_whole());
    CHECK(bench.session.settings().width == 300);
    size.resize(300, 200);
    CHECK_FALSE(size.apply(bench.session, false));
}

TEST_CASE("Picture size: stays coarse until a frame has shown the last place of the camera") {
    PictureSize size(64, 64);
    Requests now;
    CHECK_FALSE(size.is_coarse(now));
    now.moving = true;
    CHECK(size.is_coarse(now));
    size.move_camera();
    now.moving = false;
    CHECK(size.is_coarse(now));
    now.low_resolution = false;
    CHECK_FALSE(size.is_coarse(now));
    now.low_resolution = true;
    size.note_frame();
    CHECK_FALSE(size.is_coarse(now));
}
