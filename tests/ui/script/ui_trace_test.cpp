#include "tests/support/catch.hpp"
#include "tests/support/files/temporary_folder.h"
#include "ui/script/ui_trace.h"

using namespace pl;
using namespace pl::ui;

TEST_CASE("UI trace: percentiles interpolate, latencies run from a move to the picture that shows it") {
    CHECK(percentile({}, 0.5) == 0.0);
    CHECK(percentile({3.0}, 0.95) == 3.0);
    CHECK(percentile({4.0, 1.0, 3.0, 2.0}, 0.5) == Approx(2.5));
    CHECK(percentile({4.0, 1.0, 3.0, 2.0}, 1.0) == 4.0);

    const test::TemporaryFolder folder;
    UiTrace trace(folder.path() / "trace.jsonl");
    trace.camera_moved(1.0, 5);
    trace.camera_moved(1.1, 6);                        // same motion
    trace.frame_shown(1.02, {0.004, 0.003, -1.0}, 4);  // does not show them yet
    trace.frame_shown(1.05, {0.004, 0.003, 0.016}, 5);
    trace.backend_asked(1.18, 7);
    trace.frame_shown(1.20, {0.006, 0.003, 0.016}, 7);
    trace.backend_asked(1.30, 8);  // its picture never comes
    trace.frame_shown(1.40, {0.006, 0.003, 0.016}, 7);
    const std::string summary = trace.finish();
    CHECK_THAT(summary, test::contains("first picture after a rest   p50   50.00 ms"));
    CHECK_THAT(summary, test::contains("input to picture             p50   75.00 ms"));
    CHECK_THAT(summary, test::contains("n 4"));
    CHECK_THAT(summary, test::contains("switch of back ends          p50   20.00 ms"));
    CHECK_THAT(summary, test::contains("max   20.00 ms   n 1"));
}
