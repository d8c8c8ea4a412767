#include "core/io/sky/sun_position.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace pl {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

double universal_hours(const SunTime& time) {
    return time.hour - time.timezone + (time.minute + time.second / 60.0) / 60.0;
}

/// Days since noon of 1 January 2000, universal time. Divisions of integers round towards 0.
double days_of(const SunTime& time) {
    const std::int64_t january = (time.month - 14) / 12;  // -1 in January and February, else 0
    const std::int64_t day = 1461 * (time.year + 4800 + january) / 4 + 367 * (time.month - 2 - 12 * january) / 12 -
                             3 * ((time.year + 4900 + january) / 100) / 4 + time.day - 32075;
    return static_cast<double>(day) - 0.5 + universal_hours(time) / 24.0 - 2451545.0;
}

/// Longitude and obliquity of the ecliptic, in radians.
struct Ecliptic {
    double longitude, obliquity;
};
Ecliptic ecliptic_of(double days) {
    const double node = 2.1429 - 0.0010394594 * days;
    const double anomaly = 6.2400600 + 0.0172019699 * days;
    const double mean_longitude = 4.8950630 + 0.017202791698 * days;
    return {mean_longitude + 0.03341607 * std::sin(anomaly) + 0.00034894 * std::sin(2.0 * anomaly) - 0.0001134 -
                0.0000203 * std::sin(node),
            0.4090928 - 6.2140e-9 * days + 0.0000396 * std::cos(node)};
}

}  // namespace

glm::dvec3 sun_towards(const SunTime& time) {
    const double days = days_of(time);
    const Ecliptic ecliptic = ecliptic_of(days);
    const double sine = std::sin(ecliptic.longitude);
    const double right_ascension = std::atan2(std::cos(ecliptic.obliquity) * sine, std::cos(ecliptic.longitude));
    const double declination = std::asin(std::sin(ecliptic.obliquity) * sine);
    const double sidereal_hours = 6.6974243242 + 0.0657098283 * days + universal_hours(time);
    const double hour_angle = (sidereal_hours * 15.0 + time.longitude) * kRadians - right_ascension;
    const double latitude = time.latitude * kRadians;

    const double up = std::cos(latitude) * std::cos(hour_angle) * std::cos(declination) +
                      std::sin(declination) * std::sin(latitude);
    const double azimuth = std::atan2(-std::sin(hour_angle), std::tan(declination) * std::cos(latitude) -
                                                                 std::sin(latitude) * std::cos(hour_angle));
    // Seen from the surface of the earth the sun stands a little lower than from its center.
    constexpr double kEarthOverDistance = 6371.01 / 149597890.0;
    const double center = std::acos(std::fmin(std::fmax(up, -1.0), 1.0));
    const double zenith = center + kEarthOverDistance * std::sin(center);
    return {std::sin(zenith) * std::sin(azimuth), std::sin(zenith) * std::cos(azimuth), std::cos(zenith)};
}

}  // namespace pl
