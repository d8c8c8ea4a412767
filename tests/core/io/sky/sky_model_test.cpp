// The clear sky: radiance of the model as another program computes it, horizon and night, and its place in a scene.
// The position of the sun against equinoxes, solstices and noons of almanacs.
#include "core/io/sky/sky_model.h"

#include <cmath>
#include <numbers>

#include "tests/support/catch.hpp"

using namespace pl;

namespace {

/// z is up; the sun stands over +x.
SkyDescription sky_with(float elevation_deg, float turbidity) {
    const float elevation = elevation_deg * std::numbers::pi_v<float> / 180.0f;
    return {.up = {0.0f, 0.0f, 1.0f},
            .sun_direction = {std::cos(elevation), 0.0f, std::sin(elevation)},
            .turbidity = turbidity};
}

void check_near(const glm::vec3& value, const glm::vec3& expected, double relative, double absolute) {
    for (int channel = 0; channel < 3; ++channel)
        CHECK(value[channel] == Approx(expected[channel]).epsilon(relative).margin(absolute));
}

}  // namespace

TEST_CASE("sky: radiance and sun are those of the model") {
    // By Mitsuba 3.9.1, `sunsky`, with four decimals.
    struct Case {
        float elevation, turbidity;
        glm::vec3 zenith, opposite;
    };
    const glm::vec3 opposite{-std::cos(0.35f), 0.0f, std::sin(0.35f)};
    for (const Case& expected : {Case{60, 2, {0.0265f, 0.0462f, 0.0984f}, {0.0517f, 0.0943f, 0.1722f}},
                                 Case{60, 6, {0.0838f, 0.1034f, 0.147f}, {0.0655f, 0.1045f, 0.1763f}},
                                 Case{30, 3, {0.0165f, 0.0313f, 0.0625f}, {0.055f, 0.0936f, 0.1476f}},
                                 Case{10, 3, {0.0084f, 0.017f, 0.0299f}, {0.0477f, 0.0696f, 0.0856f}}}) {
        const SkyModel model(sky_with(expected.elevation, expected.turbidity));
        check_near(model.radiance({0, 0, 1}), expected.zenith, 1e-3, 6e-5);
        check_near(model.radiance(opposite), expected.opposite, 1e-3, 6e-5);
    }
    check_near(SkyModel(sky_with(60, 3)).sun_radiance(), {21873.3f, 18316.1f, 14105.9f}, 2e-3, 0.0);
    check_near(SkyModel(sky_with(30, 3)).sun_radiance(), {20274.4f, 15949.6f, 10618.1f}, 2e-3, 0.0);
    check_near(SkyModel(sky_with(10, 3)).sun_radiance(), {14494.3f, 8789.18f, 3141.14f}, 0.05, 0.0);
}

TEST_CASE("sky: between the turbidities and albedos of the data values are between theirs") {
    const auto zenith = [](float turbidity, float albedo) {
        SkyDescription sky = sky_with(40, turbidity);
        sky.albedo = glm::vec3(albedo);
        return SkyModel(sky).radiance({0, 0, 1}).y;
    };
    CHECK((zenith(4.5f, 0.3f) > zenith(4, 0.3f) && zenith(4.5f, 0.3f) < zenith(5, 0.3f)));
    CHECK((zenith(4, 0.5f) > zenith(4, 0) && zenith(4, 0.5f) < zenith(4, 1)));
    CHECK(std::isfinite(zenith(kLeastTurbidity, 0)));
    CHECK(std::isfinite(zenith(kMostTurbidity, 1)));
}

TEST_CASE("sky: nothing below the horizon, and nothing at night") {
    const SkyModel day(sky_with(45, 3));
    CHECK(day.radiance({0, 0, -1}) == glm::vec3(0.0f));
    CHECK(day.radiance({1, 0, 0}).x > 0.0f);
    const SkyModel night(sky_with(-1, 3));
    CHECK(night.radiance({0, 0, 1}) == glm::vec3(0.0f));
    CHECK(night.sun_radiance() == glm::vec3(0.0f));
}

TEST_CASE("sky: the map has the model's radiance, the sun its irradiance whatever its size") {
    SceneDescription scene;
    const SkyDescription sky{.sun_direction = glm::normalize(glm::vec3(1, 1, -1))};
    add_sky(sky, scene);
    const EnvironmentMapDescription& map = scene.environment_map;
    REQUIRE(map.texels.size() == 512 * 256);
    // The middle column is towards -z, columns to its right towards +x, the lower half below the horizon.
    const std::size_t row = 63;
    const double colatitude = std::numbers::pi * 63.5 / 256.0;
    const double longitude = 2.0 * std::numbers::pi * 128.5 / 512.0;
    const glm::vec3 expected =
        SkyModel(sky).radiance(glm::vec3(std::sin(colatitude) * std::sin(longitude), std::cos(colatitude),
                                         -std::sin(colatitude) * std::cos(longitude)));
    check_near(map.texels[row * 512 + 384], expected, 2e-4, 0.0);
    CHECK(map.texels[200 * 512] == glm::vec3(0.0f));
    CHECK(scene.sun.direction == sky.sun_direction);
    SkyDescription wide = sky;
    wide.sun_angle = 2.0f * sky.sun_angle;
    SceneDescription other;
    add_sky(wide, other);
    CHECK(other.sun.radiance.y == Approx(0.25f * scene.sun.radiance.y).epsilon(1e-3));
    wide.sky_scale = 0.0f;
    SceneDescription sun_alone;
    add_sky(wide, sun_alone);
    CHECK(sun_alone.environment_map.texels.empty());
}

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
