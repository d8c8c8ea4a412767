#include "core/base/usable_threads.h"

#include <algorithm>
#include <thread>

#include "tests/support/catch.hpp"

using namespace pl;

TEST_CASE("A quota of processor time is so many processors, rounded up") {
    CHECK(processors_of_quota("1600000 100000") == 16);
    CHECK(processors_of_quota("150000 100000") == 2);
    CHECK(processors_of_quota("1 100000") == 1);
    CHECK(processors_of_quota("9223372036854775807 1") == 2147483647);
}

TEST_CASE("Without a quota there is no limit") {
    for (const char* text : {"max 100000", "-1 100000", "0 100000", "100000 0", "", " ", "100000", "100000 ",
                             "100000 x", "100000 100000 1", "1e5 100000", "99999999999999999999 100000"}) {
        INFO(text);
        CHECK_FALSE(processors_of_quota(text));
    }
}

TEST_CASE("At least one thread runs here, and no more than there are processors") {
    CHECK(usable_threads() >= 1);
    CHECK(usable_threads() <= std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
}
