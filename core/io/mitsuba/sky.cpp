#include "core/io/mitsuba/sky.h"

#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "core/io/sky/sky_model.h"

namespace pl {
namespace {

/// Towards the sun where neither direction nor date is given, on a July afternoon in Tokyo; z is up.
constexpr glm::dvec3 kStandardSun{0.0509, 0.6934, 0.7188};

bool has_date(const MitsubaObject& emitter) {
    constexpr std::array<const char*, 9> kNames = {"year",   "month",     "day",      "hour",    "minute",
                                                   "second", "longitude", "latitude", "timezone"};
    for (const char* name : kNames)
        if (emitter.property(name)) return true;
    return false;
}

glm::vec3 unit_of(const MitsubaObject& emitter, const glm::dvec3& direction) {
    const double length = glm::length(direction);
    if (!(length > 0.0) || !std::isfinite(length)) emitter.fail("expected a direction, got a vector of no length");
    return glm::vec3(direction / length);
}

float within(const MitsubaObject& emitter, const char* name, float standard, float low, float high) {
    const float value = emitter.number(name).value_or(standard);
    if (!(value >= low && value <= high))
        emitter.fail(fmt::format("'{}': expected a number from {} to {}, got {}", name, low, high, value));
    return value;
}

/// Up and the sun in the world: z is up in the emitter's own frame, in 0.6 y.
void place_sun(const MitsubaObject& emitter, SkyDescription& sky) {
    glm::dmat3 to_world(emitter.transform("to_world"));
    if (emitter.is_of_version_0()) to_world = to_world * glm::dmat3({1, 0, 0}, {0, 0, -1}, {0, 1, 0});
    sky.up = unit_of(emitter, to_world[2]);
    const auto given = emitter.point("sun_direction");
    sky.sun_direction = unit_of(emitter, given ? glm::dvec3(*given) : to_world * kStandardSun);
    if (!given && has_date(emitter)) emitter.note("the sun is not placed by date and time, but as without them");
}

}  // namespace

bool add_mitsuba_sky(const MitsubaObject& emitter, SceneDescription& scene) {
    const std::string type = emitter.type();
    if (type != "sunsky" && type != "sky" && type != "sun") return false;
    SkyDescription sky;
    place_sun(emitter, sky);
    sky.turbidity = within(emitter, "turbidity", sky.turbidity, kLeastTurbidity, kMostTurbidity);
    sky.albedo = emitter.color("albedo").value_or(sky.albedo);
    if (!glm::all(glm::greaterThanEqual(sky.albedo, glm::vec3(0.0f))) ||
        !glm::all(glm::lessThanEqual(sky.albedo, glm::vec3(1.0f))))
        emitter.fail("'albedo': expected a color within [0, 1]");
    const float scale = within(emitter, "scale", 1.0f, 0.0f, kMostSkyScale);
    sky.sky_scale = type == "sun" ? 0.0f : scale * within(emitter, "sky_scale", 1.0f, 0.0f, kMostSkyScale);
    sky.sun_scale = type == "sky" ? 0.0f : scale * within(emitter, "sun_scale", 1.0f, 0.0f, kMostSkyScale);
    sky.sun_angle = within(emitter, "sun_aperture", sky.sun_angle, kLeastSunAngle, kMostSunAngle);
    // 0.6 may have the sky in one emitter and the sun in another.
    SceneDescription added;
    added.source = scene.source;
    add_sky(sky, added);
    const bool has_two = (!added.environment_map.texels.empty() && !scene.environment_map.texels.empty()) ||
                         (added.sun.radiance != glm::vec3(0.0f) && scene.sun.radiance != glm::vec3(0.0f));
    if (has_two) {
        emitter.note("of two skies, environment maps or suns the first one is shown");
        return true;
    }
    if (!added.environment_map.texels.empty()) scene.environment_map = std::move(added.environment_map);
    if (added.sun.radiance != glm::vec3(0.0f)) scene.sun = added.sun;
    return true;
}

}  // namespace pl
