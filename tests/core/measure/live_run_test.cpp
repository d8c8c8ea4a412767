// The picture that is dropped first when memory runs out.
#include "core/measure/live_run.h"

#include "tests/support/catch.hpp"

using namespace pl;

namespace {

/// A run of a picture, with a stored picture at each of these charged seconds.
std::shared_ptr<const LiveRun> run_of(std::uint64_t picture, const std::vector<double>& seconds) {
    LiveRun run;
    run.label.picture = picture;
    for (const double time : seconds) {
        LivePoint& point = run.points.emplace_back();
        point.clocks.render = time;
        point.picture = std::make_shared<const HalfPicture>();
    }
    return std::make_shared<const LiveRun>(run);
}

}  // namespace

TEST_CASE("Picture memory: the oldest run of another picture goes first") {
    const PicturePlace first =
        least_needed_picture({run_of(1, {1.0, 2.0}), run_of(2, {1.0, 2.0}), run_of(3, {1.0})}, 1);
    CHECK(first.run == 1);
    CHECK(first.point == 0);
}

TEST_CASE("Picture memory: of the present picture the one closest to its neighbors goes first, the last one last") {
    const PicturePlace first = least_needed_picture({run_of(1, {1.0, 4.0, 5.0, 6.0, 40.0})}, 1);
    CHECK(first.point == 2);
    CHECK(least_needed_picture({run_of(1, {3.0}), run_of(1, {1.0, 9.0})}, 1).run == 1);
}
