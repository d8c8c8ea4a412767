// Numbers as short texts.
#include "ui/draw/value_text.h"

#include <limits>

#include "tests/support/catch.hpp"

using namespace pl;
using namespace pl::ui;

TEST_CASE("Short values: three digits, or two and an exponent, also where rounding changes the power of ten") {
    CHECK(short_value(0.0) == "0");
    CHECK(short_value(0.25) == "0.25");
    CHECK(short_value(-0.012345) == "-0.0123");
    CHECK(short_value(0.0099999) == "0.01");
    CHECK(short_value(-0.00996) == "-0.01");
    CHECK(short_value(0.00994) == "9.9e-3");
    CHECK(short_value(9.996e-5) == "1.0e-4");
    CHECK(short_value(2.7e-40) == "2.7e-40");
    CHECK(short_value(999.4) == "999");
    CHECK(short_value(1234.0) == "1234");
    CHECK(short_value(9999.7) == "1.0e4");
    CHECK(short_value(99999.0) == "1.0e5");
    CHECK(short_value(std::numeric_limits<double>::infinity()) == "inf");
}

TEST_CASE("Short numbers and seconds have a unit") {
    CHECK(short_number(7.0) == "7");
    CHECK(short_number(12345678.0) == "12.3 M");
    CHECK(short_seconds(0.085) == "85 ms");
    CHECK(short_seconds(1.25) == "1.25 s");
    CHECK(short_seconds(140.0) == "140 s");
}

TEST_CASE("Words: one is not many") {
    CHECK(passes_text(0) == "0 passes");
    CHECK(passes_text(1) == "1 pass");
    CHECK(passes_text(12) == "12 passes");
    CHECK(light_samples_text(true) == std::string("light samples on"));
    CHECK(light_samples_text(false) == std::string("light samples off"));
}

TEST_CASE("Lines break at spaces, never within a number or before its unit") {
    const auto letters = [](std::string_view part) { return static_cast<float>(part.size()); };
    const auto broken = [&](std::string_view text, float width) { return broken_at_spaces(text, width, letters); };
    CHECK(broken("undecided (95 %: 0.67 to 8.8)", 19.0f) == "undecided (95 %:\n0.67 to 8.8)");
    CHECK(broken("2.4 to 2.6", 10.0f) == "2.4 to 2.6");
    CHECK(broken("2.4 to 2.6", 9.0f) == "2.4 to\n2.6");
    CHECK(broken("one\ntwo three", 7.0f) == "one\ntwo\nthree");
    CHECK(broken("a word-that-is-long b", 6.0f) == "a\nword-that-is-long\nb");
    CHECK(broken("takes 2.5 s more", 9.0f) == "takes\n2.5 s\nmore");
    CHECK(broken("Default CPU  22 spp  4.18 s", 15.0f) == "Default CPU \n22 spp  4.18 s");
    CHECK(broken("", 5.0f).empty());
}

TEST_CASE("Method keys: all methods, or those with a flag") {
    CHECK(method_keys() == "1, 2, 3");
    CHECK(method_keys(&MethodInfo::uses_field) == "2, 3");
    CHECK(method_keys(&MethodInfo::precomputes) == "2");
    CHECK(method_keys(&MethodInfo::learns) == "3");
}
