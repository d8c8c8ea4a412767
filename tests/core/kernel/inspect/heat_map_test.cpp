// Heat maps: the numbers of small fields, worked out by hand, and the colors that show them.
#include "core/kernel/inspect/heat_map.h"

#include <algorithm>
#include <vector>

#include "core/kernel/film/heat_color.h"
#include "core/kernel/film/tonemap.h"
#include "tests/support/catch.hpp"
#include "tests/support/field/field_fixture.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr View kHeatMaps[] = {View::Visits,    View::Irradiance, View::Entropy,
                              View::BsdfShare, View::Change,     View::Unvisited};

/// Two volumes of 2 x 2 cells; the second one is judged.
struct TwoVolumes : TestField {
    TwoVolumes() : TestField(2, {Vec3f{0, 0, 1}, Vec3f{0, 0, -1}}) {}
    float value(View view, std::uint32_t volume = 1) {
        return volume_value(TableVolumeSummary{update_view()}, volume, view);
    }
};

/// Relative luminance of an sRGB color.   [IEC 61966-2-1]
double luminance_of(ByteColor color) {
    const auto linear = [](std::uint8_t code) {
        const double c = code / 255.0;
        return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(color.r) + 0.7152 * linear(color.g) + 0.0722 * linear(color.b);
}

}  // namespace

TEST_CASE("Own logarithm: exact for powers of two, else within its bound") {
    for (int exponent = -126; exponent < 128; ++exponent) {
        CHECK(log2_normal(std::ldexp(1.0f, exponent)) == static_cast<float>(exponent));
        for (int i = 1; i < 200; ++i) {
            const float x = std::ldexp(1.0f + static_cast<float>(i) / 200.0f, exponent);
            const double exact = std::log2(static_cast<double>(x));
            REQUIRE(std::fabs(static_cast<double>(log2_normal(x)) - exact) < 2e-7 * (1.0 + std::fabs(exact)));
        }
    }
}

TEST_CASE("Heat maps: values by hand") {
    TwoVolumes field;
    // The values of the first volume must not matter.
    field.tables.visits = {9, 9, 9, 9, 5, 0, 7, 0};
    CHECK(field.value(View::Visits) == 12.0f);
    CHECK(field.value(View::Unvisited) == 0.5f);
    CHECK(field.value(View::Visits, 0) == 36.0f);
    CHECK(field.value(View::Unvisited, 0) == 0.0f);

    field.tables.mean_radiance = {100.0f, 4.0f};
    field.tables.change = {100.0f, 1.0f};
    field.tables.bsdf_fraction = {0.9f, 0.25f};
    CHECK(field.value(View::Irradiance) == kPi * 4.0f);
    CHECK(field.value(View::Change) == 0.25f);
    CHECK(field.value(View::BsdfShare) == 0.25f);

    // Probabilities 1/2, 1/4, 1/8, 1/8: 1/2 + 2/4 + 3/8 + 3/8 bits.
    field.set_weights({4, 2, 1, 1}, 1);
    CHECK(field.value(View::Entropy) == Approx(1.75).epsilon(1e-6));
    field.set_weights({0, 0, 1, 0}, 1);
    CHECK(field.value(View::Entropy) == 0.0f);
    field.set_weights({1, 0, 0, 1}, 1);
    CHECK(field.value(View::Entropy) == 1.0f);
    CHECK(field.value(View::Entropy, 0) == 2.0f);  // nothing learned: uniform
}

TEST_CASE("Heat maps: counts beyond 32 bits do not wrap") {
    TwoVolumes field;
    std::fill(field.tables.visits.begin(), field.tables.visits.end(), 0xffffffffu);
    CHECK(field.value(View::Visits) == 0x1p34f);
}

TEST_CASE("Heat maps: change and visits after an update") {
    TwoVolumes field;
    for (int i = 0; i < 3; ++i) record(field.view(), 1, 2, 0.5f);
    record(field.view(), 1, 0, 0.25f);
    field.update();
    CHECK(field.value(View::Visits) == 4.0f);
    CHECK(field.value(View::Unvisited) == 0.5f);
    CHECK(field.value(View::Irradiance) == kPi * 0.375f);
    // Both cells started at 0, so that their change is their value.
    CHECK(field.value(View::Change) == 1.0f);
    CHECK(field.value(View::Entropy) > 1.0f);
    CHECK(field.value(View::Entropy) < 2.0f);
    CHECK(field.value(View::Change, 0) == 0.0f);
    CHECK(field.value(View::Unvisited, 0) == 1.0f);
}

TEST_CASE("Heat maps: finite and not negative whatever memory holds") {
    for (const float bad : {kNan, kInfinity, -kInfinity, -1.0f, 0.0f, 1e-45f, 3e38f}) {
        TwoVolumes field;
        for (LargeArray<float>* values :
             {&field.tables.mean_radiance, &field.tables.change, &field.tables.bsdf_fraction, &field.tables.row_cdf,
              &field.tables.column_cdf}) {
            field.tables.change = {1.0f, 1.0f};
            std::fill(values->begin(), values->end(), bad);
            for (const View view : kHeatMaps) {
                INFO(bad << ", " << static_cast<int>(view));
                CHECK(is_valid_radiance(Vec3f{field.value(view)}));
            }
        }
    }
}

TEST_CASE("Heat maps are the views from visits on") {
    for (const View view : kHeatMaps) CHECK(is_heat_map(view));
    for (const View view :
         {View::Beauty, View::Direct, View::RadianceMap, View::Voronoi, View::Normal, View::Albedo, View::Depth}) {
        CHECK_FALSE(is_heat_map(view));
        TwoVolumes field;
        CHECK(field.value(view) == 0.0f);
    }
}

TEST_CASE("Heat colors: from dark to light, evenly, and clamped") {
    constexpr int kShares = 1000;
    double last = -1.0;
    for (int i = 0; i <= kShares; ++i) {
        const double now = luminance_of(heat_color(static_cast<float>(i) / kShares));
        // Rounding of a channel to 8 bits may undo less than a thousandth.
        REQUIRE(now > last - 1.5e-3);
        last = std::max(last, now);
    }
    double below = luminance_of(heat_color(0.0f));
    for (int step = 1; step <= kHeatSteps; ++step) {
        const double now = luminance_of(heat_color(static_cast<float>(step) / kHeatSteps));
        CHECK(now > below);
        // Lightness in CIELAB: 78 in 16 even steps.
        const auto lightness = [](double y) { return 116.0 * std::cbrt(y) - 16.0; };
        if (below > 0.0089) CHECK(lightness(now) - lightness(below) == Approx(78.0 / 16.0).margin(0.6));
        below = now;
    }
    CHECK((heat_color(-1.0f) == heat_color(0.0f)));
    CHECK((heat_color(kInfinity) == heat_color(1.0f)));
    CHECK((heat_color(-kInfinity) == heat_color(0.0f)));
    CHECK((heat_color(0.0f) == ByteColor{43, 23, 81}));
    CHECK((heat_color(1.0f) == ByteColor{248, 235, 122}));
    CHECK((heat_color(kNan) == ByteColor{255, 0, 255}));
}
