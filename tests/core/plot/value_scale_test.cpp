#include "core/plot/value_scale.h"

#include <array>

#include "tests/support/catch.hpp"

using namespace pl;

TEST_CASE("a range maps low to 0 and high to 1, and its values back") {
    for (const ValueRange range :
         {ValueRange{ColorScale::Linear, 0.5f, 4.5f}, ValueRange{ColorScale::Logarithmic, 0.01f, 100.0f}}) {
        CHECK(range.position(range.low) == 0.0f);
        CHECK(range.position(range.high) == 1.0f);
        CHECK(range.position(0.0f) == 0.0f);
        CHECK(range.position(1000.0f) == 1.0f);
        for (const float value : {0.6f, 1.0f, 3.0f})
            CHECK_THAT(range.value_at(range.position(value)), WithinRel(value, 1.0e-5f));
    }
    CHECK_THAT((ValueRange{ColorScale::Logarithmic, 0.01f, 100.0f}.position(1.0f)), WithinAbs(0.5f, 1.0e-6f));
}

TEST_CASE("a range covers the percentiles asked for") {
    std::array<float, 101> values{};
    for (std::size_t i = 0; i < values.size(); ++i) values[values.size() - 1 - i] = static_cast<float>(i);
    const ValueRange all = range_of(values, {ColorScale::Linear, 0.0f, 100.0f});
    CHECK(all.low == 0.0f);
    CHECK(all.high == 100.0f);
    const ValueRange inner = range_of(values, {ColorScale::Linear, 10.0f, 90.0f});
    CHECK(inner.low == 10.0f);
    CHECK(inner.high == 90.0f);
    const ValueRange decades = range_of(values, {ColorScale::Logarithmic, 0.0f, 100.0f});
    CHECK_THAT(decades.low, WithinRel(0.1f, 1.0e-5f));
    CHECK(range_of(values, {ColorScale::Logarithmic, 50.0f, 100.0f}).low == 50.0f);
    for (float& value : values) value += 20.0f;
    CHECK(range_of(values, {ColorScale::Logarithmic, 0.0f, 100.0f}).low == 20.0f);
}

TEST_CASE("a range is never empty") {
    const std::array<float, 3> zeros{};
    const std::array<float, 3> equal{2.0f, 2.0f, 2.0f};
    const std::array<float, 3> one_lit{0.0f, 0.0f, 7.0f};
    for (const ColorScale scale : {ColorScale::Linear, ColorScale::Logarithmic})
        for (const RangeRule& rule : {RangeRule{scale, 0.0f, 100.0f}, RangeRule{scale, 50.0f, 50.0f}})
            for (const std::array<float, 3>& values : {zeros, equal, one_lit}) {
                const ValueRange range = range_of(values, rule);
                CHECK(range.low < range.high);
                CHECK(range.low >= (scale == ColorScale::Linear ? 0.0f : 1.0e-6f));
            }
    CHECK(range_of(one_lit, {ColorScale::Linear, 0.0f, 10.0f}).high == 7.0f);
}
