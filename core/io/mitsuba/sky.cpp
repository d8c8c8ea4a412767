#include "core/io/mitsuba/sky.h"

#include <cmath>
#include <string>
#include <type_traits>

#include <fmt/format.h>

#include "core/io/sky/sky_model.h"
#include "core/io/sky/sun_position.h"

namespace pl {
namespace {

/// Years that are accepted. The error of sun_towards() is known for those from 1999 to 2015.
constexpr float kFirstYear = 1900.0f;
constexpr float kLastYear = 2100.0f;

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

SunTime time_of(const MitsubaObject& emitter) {
    SunTime time;
    const auto read = [&](const char* name, auto& value, float low, float high) {
        using Value = std::remove_reference_t<decltype(value)>;
        if (emitter.property(name)) value = static_cast<Value>(within(emitter, name, 0.0f, low, high));
    };
    read("year", time.year, kFirstYear, kLastYear);
    read("month", time.month, 1.0f, 12.0f);
    read("day", time.day, 1.0f, 31.0f);
    read("hour", time.hour, 0.0f, 24.0f);
    read("minute", time.minute, 0.0f, 60.0f);
    read("second", time.second, 0.0f, 60.0f);
    read("latitude", time.latitude, -90.0f, 90.0f);
    read("longitude", time.longitude, -180.0f, 180.0f);
    read("timezone", time.timezone, -15.0f, 15.0f);
    return time;
}

/// Up and the sun in the world: z is up in the emitter's own frame, and x to the south and y to the west of a date; in 0.6 y is up, x
/// to the east and z to the south.
void place_sun(const MitsubaObject& emitter, SkyDescription& sky) {
    const glm::dmat3 to_world(emitter.transform("to_world"));
    const bool is_old = emitter.is_of_version_0();
    sky.up = unit_of(emitter, to_world[is_old ? 1 : 2]);
    if (const auto given = emitter.point("sun_direction")) {
        sky.sun_direction = unit_of(emitter, *given);
        return;
    }
    const glm::dvec3 sun = sun_towards(time_of(emitter));
    const glm::dvec3 local = is_old ? glm::dvec3{sun.x, sun.z, -sun.y} : glm::dvec3{-sun.y, -sun.x, sun.z};
    sky.sun_direction = unit_of(emitter, to_world * local);
    if (!(sun.z > 0.0)) emitter.note("the sun is below the horizon: its sky is black");
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
