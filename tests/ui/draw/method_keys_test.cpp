#include "tests/support/catch.hpp"
#include "ui/draw/method_keys.h"

using namespace pl;
using namespace pl::ui;

TEST_CASE("Method keys: all methods, or those with a flag") {
    CHECK(method_keys() == "1, 2, 3");
    CHECK(method_keys(&MethodInfo::uses_field) == "2, 3");
    CHECK(method_keys(&MethodInfo::precomputes) == "2");
    CHECK(method_keys(&MethodInfo::learns) == "3");
}
