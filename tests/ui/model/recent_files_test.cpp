#include "tests/support/catch.hpp"
#include "ui/model/recent_files.h"

using namespace pl;
using namespace pl::ui;

using Names = std::vector<std::string>;

TEST_CASE("Recent files: newest first, each once, ten of them") {
    RecentFiles recent;
    for (const char* name : {"a", "b", "c", "a"}) recent.add(name);
    CHECK(recent.names() == Names{"a", "c", "b"});
    for (int i = 0; i < 12; ++i) recent.add(std::to_string(i));
    REQUIRE(recent.names().size() == RecentFiles::kMost);
    CHECK(recent.names().front() == "11");
    CHECK(recent.names().back() == "2");
}

TEST_CASE("Recent files: a stored list comes back in its order, without what breaks the rules") {
    RecentFiles recent;
    recent.add("old");
    recent.set({"x", "y", "x", "z"});
    CHECK(recent.names() == Names{"x", "y", "z"});
    recent.set(Names(20, "same"));
    CHECK(recent.names() == Names{"same"});
}
