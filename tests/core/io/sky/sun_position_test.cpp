// The position of the sun against equinoxes, solstices and noons of almanacs.
#include "core/io/sky/sun_position.h"

#include <cmath>
#include <numbers>

#include "tests/support/catch.hpp"

using namespace pl;

namespace {

constexpr double kHalfMinute = 1.5e-4;  ///< of arc, in radians: what the source states
const double kTilt = std::sin(23.438 / 180.0 * std::numbers::pi);

/// Sine of the declination: of the height over the horizon of the north pole.
double height_at_pole(int month, int day, double hour, double minute) {
    return sun_towards({.year = 2010,
                        .month = month,
                        .day = day,
                        .hour = hour,
                        .minute = minute,
                        .second = 0.0,
                        .latitude = 90.0,
                        .longitude = 0.0,
                        .timezone = 0.0})
        .z;
}

}  // namespace

TEST_CASE("sun position: it crosses the equator at the equinoxes and turns at the solstices") {
    CHECK(height_at_pole(3, 20, 17, 32) == Approx(0.0).margin(kHalfMinute));
    CHECK(height_at_pole(9, 23, 3, 9) == Approx(0.0).margin(kHalfMinute));
    CHECK(height_at_pole(6, 21, 11, 28) == Approx(kTilt).margin(kHalfMinute));
    CHECK(height_at_pole(12, 21, 23, 38) == Approx(-kTilt).margin(kHalfMinute));
    CHECK(height_at_pole(1, 1, 0, 0) < -0.38);  // -23.0 degrees, in the month that is counted with the year before
}

TEST_CASE("sun position: at noon it is in the south, before it in the east") {
    SunTime time{.year = 2010,
                 .month = 4,
                 .day = 15,  // when clocks and the sun agree
                 .hour = 12.0,
                 .minute = 0.0,
                 .second = 0.0,
                 .latitude = 51.4769,
                 .longitude = 0.0,
                 .timezone = 0.0};
    const glm::dvec3 noon = sun_towards(time);
    CHECK(noon.x == Approx(0.0).margin(1e-3));
    CHECK(noon.y < -0.5);
    CHECK(std::asin(noon.z) * 180.0 / std::numbers::pi == Approx(90.0 - 51.4769 + 9.8).margin(0.1));
    CHECK(glm::length(noon) == Approx(1.0));
    time.hour = 7.0;
    CHECK(sun_towards(time).x > 0.9);
    time.hour = 17.0;
    CHECK(sun_towards(time).x < -0.9);
}

TEST_CASE("sun position: a zone ahead of universal time, minutes and seconds") {
    const glm::dvec3 tokyo = sun_towards({});
    SunTime same{.hour = 5.0, .minute = 59.0, .second = 60.0, .timezone = 0.0};
    CHECK(glm::length(tokyo - sun_towards(same)) < 1e-9);
    CHECK(tokyo.x < -0.6);  // in the west
}
