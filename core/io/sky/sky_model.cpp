#include "core/io/sky/sky_model.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/io/sky/hosek_wilkie_data.h"
#include "core/scene/sky_map.h"

namespace pl {
namespace {

namespace data = hosek_wilkie;

constexpr double kRightAngle = std::numbers::pi / 2.0;
/// Angular diameter of the disc that the radiance of the sun is an average over, in degrees.
constexpr double kDataSunAngle = 0.5358;

/// Two neighbors in a row of values, and the weight of the second.
struct Between {
    std::size_t low;
    double share;
};
Between between(double x, int count) {
    const double clamped = std::clamp(x, 0.0, static_cast<double>(count - 1));
    const auto low = std::min(static_cast<std::size_t>(clamped), static_cast<std::size_t>(count - 2));
    return {low, clamped - static_cast<double>(low)};
}
Between turbidity_of(const SkyDescription& sky) {
    return between(static_cast<double>(sky.turbidity) - 1.0, data::kTurbidities);
}

/// Weights of the control points of a Bezier curve of degree 5.
std::array<double, data::kControlPoints> bezier_weights(double x) {
    constexpr std::array<double, data::kControlPoints> kBinomials{1, 5, 10, 10, 5, 1};
    std::array<double, data::kControlPoints> weights{};
    for (int k = 0; k < data::kControlPoints; ++k) {
        const auto i = static_cast<std::size_t>(k);
        weights[i] = kBinomials[i] * std::pow(x, k) * std::pow(1.0 - x, data::kControlPoints - 1 - k);
    }
    return weights;
}

/// A coefficient of a channel for turbidity, albedo and elevation of the sun. `at(turbidity, albedo, control point)`: its value there.
template <class At>
double interpolated(const SkyDescription& sky, std::size_t channel, double elevation, const At& at) {
    const auto weights = bezier_weights(std::cbrt(elevation / kRightAngle));
    const Between turbidity = turbidity_of(sky);
    const auto albedo = static_cast<double>(sky.albedo[static_cast<int>(channel)]);
    double sum = 0.0;
    for (std::size_t point = 0; point < weights.size(); ++point)
        for (std::size_t t = 0; t < 2; ++t)
            for (std::size_t a = 0; a < 2; ++a)
                sum += weights[point] * (t == 0 ? 1.0 - turbidity.share : turbidity.share) *
                       (a == 0 ? 1.0 - albedo : albedo) * static_cast<double>(at(turbidity.low + t, a, point));
    return sum;
}

std::size_t place_of(std::size_t turbidity, std::size_t albedo, std::size_t point, std::size_t channel) {
    return ((turbidity * data::kAlbedos + albedo) * data::kControlPoints + point) * data::kChannels + channel;
}

/// The nearest float with a mantissa of 12 bits, which does not depend on the last bits of the functions of a machine.
float rounded(double value) {
    int exponent = 0;
    const double mantissa = std::frexp(value, &exponent);
    return static_cast<float>(std::ldexp(std::round(mantissa * 4096.0), exponent - 12));
}

}  // namespace

SkyModel::SkyModel(const SkyDescription& sky)
    : sky_(sky),
      elevation_(std::asin(std::clamp(glm::dot(glm::dvec3(sky.sun_direction), glm::dvec3(sky.up)), -1.0, 1.0))) {
    if (elevation_ < 0.0) return;
    // From W m^-2 sr^-1 of the whole sensitivity of the eye, which is 106.75 nm wide, to W m^-2 sr^-1 of a nanometer.
    constexpr double kPerNanometer = 1.0 / 106.7502594;
    for (std::size_t channel = 0; channel < data::kChannels; ++channel) {
        for (std::size_t i = 0; i < data::kParameters; ++i)
            parameters_[channel][i] =
                interpolated(sky, channel, elevation_, [&](std::size_t t, std::size_t a, std::size_t point) {
                    return data::kParameterPoints[place_of(t, a, point, channel) * data::kParameters + i];
                });
        mean_[channel] = kPerNanometer *
                         interpolated(sky, channel, elevation_, [&](std::size_t t, std::size_t a, std::size_t point) {
                             return data::kRadiancePoints[place_of(t, a, point, channel)];
                         });
    }
}

glm::vec3 SkyModel::radiance(const glm::vec3& direction) const {
    const double height = glm::dot(glm::dvec3(direction), glm::dvec3(sky_.up));
    if (elevation_ < 0.0 || height < 0.0) return glm::vec3(0.0f);
    const double cos_gamma = std::clamp(glm::dot(glm::dvec3(direction), glm::dvec3(sky_.sun_direction)), -1.0, 1.0);
    const double gamma = std::acos(cos_gamma);
    glm::vec3 result;
    for (std::size_t channel = 0; channel < data::kChannels; ++channel) {
        const std::array<double, 9>& p = parameters_[channel];
        const double chi = (1.0 + cos_gamma * cos_gamma) / std::pow(1.0 + p[8] * p[8] - 2.0 * p[8] * cos_gamma, 1.5);
        const double value = mean_[channel] * (1.0 + p[0] * std::exp(p[1] / (height + 0.01))) *
                             (p[2] + p[3] * std::exp(p[4] * gamma) + p[5] * cos_gamma * cos_gamma + p[6] * chi +
                              p[7] * std::sqrt(height));
        result[static_cast<int>(channel)] = sky_.sky_scale * static_cast<float>(std::max(value, 0.0));
    }
    return result;
}

glm::vec3 SkyModel::sun_radiance() const {
    if (elevation_ < 0.0) return glm::vec3(0.0f);
    const Between turbidity = turbidity_of(sky_);
    const Between elevation = between(elevation_ / kRightAngle * (data::kElevations - 1), data::kElevations);
    const double angle = kDataSunAngle / static_cast<double>(sky_.sun_angle);
    glm::vec3 result;
    for (int channel = 0; channel < data::kChannels; ++channel) {
        double sum = 0.0;
        for (std::size_t t = 0; t < 2; ++t)
            for (std::size_t e = 0; e < 2; ++e) {
                const std::size_t place = (turbidity.low + t) * data::kElevations + elevation.low + e;
                sum += (t == 0 ? 1.0 - turbidity.share : turbidity.share) *
                       (e == 0 ? 1.0 - elevation.share : elevation.share) *
                       static_cast<double>(
                           data::kSunRadiance[place * data::kChannels + static_cast<std::size_t>(channel)]);
            }
        result[channel] = sky_.sun_scale * rounded(sum * angle * angle);
    }
    return result;
}

void add_sky(const SkyDescription& sky, SceneDescription& scene) {
    const SkyModel model(sky);
    if (sky.sky_scale > 0.0f) {
        scene.environment_map = make_sky_map(256, [&](const glm::dvec3& direction) {
            const glm::dvec3 radiance(model.radiance(glm::vec3(direction)));
            return glm::vec3(rounded(radiance.x), rounded(radiance.y), rounded(radiance.z));
        });
        scene.environment_map.source = scene.source;
    }
    scene.sun = {.direction = sky.sun_direction, .radiance = model.sun_radiance(), .angle_deg = sky.sun_angle};
}

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
