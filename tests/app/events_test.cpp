// Events are single lines of JSON.
#include <algorithm>
#include <cmath>

#include "app/events.h"
#include "tests/support/catch.hpp"

namespace pl {

TEST_CASE("an event is one line, whatever the text in it") {
    const std::string line = event_line("test", {{"message", "two\nlines \xff"}, {"number", std::nan("")}});
    CHECK(std::count(line.begin(), line.end(), '\n') == 1);
    const Json back = Json::parse(line);
    CHECK(back["schema"] == "pathlight.event/1");
    CHECK(back["event"] == "test");
    CHECK(back["number"].is_null());
}

}  // namespace pl
