#include "ui/draw/words.h"

#include "tests/support/catch.hpp"

using namespace pl;
using namespace pl::ui;

TEST_CASE("Words: one is not many") {
    CHECK(passes_text(0) == "0 passes");
    CHECK(passes_text(1) == "1 pass");
    CHECK(passes_text(12) == "12 passes");
    CHECK(light_samples_text(true) == std::string("light samples on"));
    CHECK(light_samples_text(false) == std::string("light samples off"));
}
