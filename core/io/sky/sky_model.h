// A clear sky by day, and its sun, as an environment map and a disc.
//   [Hosek and Wilkie 2012, "An Analytic Model for Full Spectral Sky-Dome Radiance"; 2013, "Adding a Solar-Radiance Function"]
#pragma once

#include <array>

#include <glm/glm.hpp>

#include "core/scene/description.h"

namespace pl {

/// Turbidity of the air: 2 is very clear, 10 hazy.
inline constexpr float kLeastTurbidity = 1.0f;
inline constexpr float kMostTurbidity = 10.0f;
/// Largest factor of radiance.
inline constexpr float kMostSkyScale = 1.0e9f;

/// Directions are unit.
struct SkyDescription {
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    glm::vec3 sun_direction{0.0f, 1.0f, 0.0f};  ///< towards the sun
    float turbidity = 3.0f;
    glm::vec3 albedo{0.3f};     ///< of the ground, each channel in [0, 1]
    float sky_scale = 1.0f;     ///< factor of the radiance of the sky, at least 0
    float sun_scale = 1.0f;     ///< and of the sun
    float sun_angle = 0.5358f;  ///< angular diameter of the sun, in degrees; its irradiance does not depend on it
};

/// Radiance in red, green and blue, W m^-2 sr^-1 nm^-1.
class SkyModel {
public:
    explicit SkyModel(const SkyDescription& sky);

    /// Of the sky without the sun from a unit direction. 0 below the horizon, and everywhere while the sun is below it.
    glm::vec3 radiance(const glm::vec3& direction) const;
    /// Of the sun, averaged over its disc; 0 while it is below the horizon.
    glm::vec3 sun_radiance() const;

private:
    SkyDescription sky_;
    double elevation_;                                   ///< of the sun, in radians
    std::array<std::array<double, 9>, 3> parameters_{};  ///< [channel]
    std::array<double, 3> mean_{};
};

/// Adds the map of the sky, and its sun, to a scene that has neither.
void add_sky(const SkyDescription& sky, SceneDescription& scene);

// Where the sun stands at a place and time.

/// A place on the earth, and its local time.
struct SunTime {
    int year = 2010;
    int month = 7;  ///< from 1 to 12
    int day = 10;   ///< from 1
    double hour = 15.0, minute = 0.0, second = 0.0;
    double latitude = 35.6894;    ///< degrees, north is positive
    double longitude = 139.6917;  ///< degrees, east is positive
    double timezone = 9.0;        ///< hours that local time is ahead of universal time
};

/// Unit vector towards the sun: x to the east, y to the north, z up. Within half a minute of arc from 1999 to 2015, without refraction.
/// [Blanco-Muriel, Alarcon-Padilla, Lopez-Moratalla, Lara-Coira 2001, "Computing the Solar Vector", with its constants]
glm::dvec3 sun_towards(const SunTime& time);

}  // namespace pl
