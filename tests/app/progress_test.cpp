// Progress bars, the rate of progress messages, and durations as text.
#include "app/progress.h"
#include "tests/support/catch.hpp"

namespace pl {

TEST_CASE("a progress bar fits its line and is as full as its share") {
    CHECK(progress_bar(0.5, "text", 27) == "[##########          ] text");
    CHECK(progress_bar(0.0, "text", 17) == "[          ] text");
    CHECK(progress_bar(1.0, "text", 17) == "[##########] text");
    CHECK(progress_bar(0.5, "a long text", 5) == "a lon");
    CHECK(progress_bar(0.5, "text", -1).empty());
    for (int width = 0; width < 120; ++width)
        CHECK(progress_bar(0.3, "rendering", width).size() <= static_cast<std::size_t>(width));
}

TEST_CASE("one message is due in every interval, and none before the end of the first") {
    MessagePace pace(5.0);
    CHECK_FALSE(pace.is_due(0.0));
    CHECK_FALSE(pace.is_due(4.9));
    CHECK(pace.is_due(5.5));
    CHECK_FALSE(pace.is_due(10.4));
    CHECK(pace.is_due(10.5));
    CHECK(pace.is_due(100.0));
    CHECK_FALSE(pace.is_due(104.9));
}

TEST_CASE("durations read well") {
    CHECK(duration_text(0.2) == "1 s");
    CHECK(duration_text(59.0) == "59 s");
    CHECK(duration_text(61.0) == "1:01 min");
    CHECK(duration_text(3600.0 * 2 + 60 * 5) == "2:05 h");
}

}  // namespace pl
