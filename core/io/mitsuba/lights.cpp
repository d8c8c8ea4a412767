#include "core/io/mitsuba/lights.h"

#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "core/io/sky/sky_model.h"
#include "core/io/texture_file.h"
#include "core/scene/punctual_lights.h"

namespace pl {
namespace {

/// A color of at least 0; 1 if there is none.
glm::vec3 strength_of(const MitsubaObject& emitter, const char* name) {
    const glm::vec3 strength = emitter.color(name).value_or(glm::vec3(1.0f)) * emitter.number("scale").value_or(1.0f);
    if (!glm::all(glm::greaterThanEqual(strength, glm::vec3(0.0f))))
        emitter.fail(
            fmt::format("expected '{}' of at least 0, got {} {} {}", name, strength.x, strength.y, strength.z));
    return strength;
}

glm::vec3 unit_of(const MitsubaObject& emitter, const glm::dvec3& direction) {
    const double length = glm::length(direction);
    if (!(length > 0.0) || !std::isfinite(length)) emitter.fail("expected a direction, got a vector of no length");
    return glm::vec3(direction / length);
}

/// Along +z of the place, or 'direction', which it turns.
glm::vec3 direction_of(const MitsubaObject& emitter) {
    glm::dvec3 local(0.0, 0.0, 1.0);
    if (const auto given = emitter.point("direction")) local = *given;
    return unit_of(emitter, glm::dmat3(emitter.transform("to_world")) * local);
}

PunctualLightDescription point_light(const MitsubaObject& emitter, const glm::dvec3& origin) {
    PunctualLightDescription light{.kind = PunctualKind::Point, .intensity = strength_of(emitter, "intensity")};
    const auto given = emitter.point("position");
    light.position = glm::vec3((given ? *given : glm::dvec3(emitter.transform("to_world")[3])) - origin);
    return light;
}

/// Falls off between beam_width and cutoff_angle, linearly over the angle. [Mitsuba 3, spot]
PunctualLightDescription spot_light(const MitsubaObject& emitter, const glm::dvec3& origin) {
    PunctualLightDescription light{.kind = PunctualKind::Spot,
                                   .position = glm::vec3(glm::dvec3(emitter.transform("to_world")[3]) - origin),
                                   .direction = direction_of(emitter),
                                   .intensity = strength_of(emitter, "intensity"),
                                   .falloff = SpotFalloff::Angle};
    light.outer_deg = emitter.number("cutoff_angle").value_or(20.0f);
    light.inner_deg = emitter.number("beam_width").value_or(0.75f * light.outer_deg);
    if (!are_cones(light.inner_deg, light.outer_deg))
        emitter.fail(
            fmt::format("expected 0 <= beam_width <= cutoff_angle, and 0 < cutoff_angle <= {}, got {} and {}",
                        kMostSpotAngle, light.inner_deg, light.outer_deg));
    if (emitter.part("texture")) emitter.note("images that spots project are left out");
    return light;
}

/// The axes of a place, orthonormal; left-handed if it mirrors.
glm::dmat3 axes_of(const MitsubaObject& emitter) {
    const glm::dmat3 place(emitter.transform("to_world"));
    const glm::dvec3 z = glm::normalize(place[2]);
    const glm::dvec3 y = glm::normalize(place[1] - glm::dot(place[1], z) * z);
    const glm::dvec3 x = glm::determinant(place) < 0.0 ? glm::cross(z, y) : glm::cross(y, z);
    const double length = glm::length(place[2]);
    constexpr double kSameAxes = 1e-4;
    if (!std::isfinite(x.x + x.y + x.z)) emitter.fail("expected a place with directions, got none");
    for (const auto& [axis, given] : {std::pair(x, place[0]), std::pair(y, place[1])})
        if (!(glm::length(given / length - axis) < kSameAxes)) {
            emitter.note("environment maps that are stretched are turned and mirrored alone");
            break;
        }
    return {x, y, z};
}

}  // namespace

EnvironmentMapDescription mitsuba_map(const MitsubaObject& emitter, std::vector<std::string>& warnings) {
    const float scale = emitter.number("scale").value_or(1.0f);
    if (!(scale >= 0.0f)) emitter.fail(fmt::format("'scale': expected a number of at least 0, got {}", scale));
    const glm::dmat3 axes = axes_of(emitter);
    // Its first column is towards -z, its middle one towards +z, seen from inside.
    constexpr double kUpright = 1e-6;
    const bool is_upright =
        glm::length(axes[1] - glm::dvec3(0.0, 1.0, 0.0)) < kUpright && glm::determinant(axes) > 0.0;
    const double yaw = is_upright ? glm::degrees(std::atan2(axes[2].x, axes[2].z)) : 0.0;
    EnvironmentMapDescription map =
        read_environment_map(emitter.file("filename"), scale, static_cast<float>(180.0 + yaw), warnings);
    if (!is_upright) map.axes = glm::mat3(axes);
    return map;
}

bool add_mitsuba_light(const MitsubaObject& emitter, SceneDescription& scene) {
    const std::string type = emitter.type();
    PunctualLightDescription light{.kind = PunctualKind::Directional};
    if (type == "point") {
        light = point_light(emitter, scene.origin);
    } else if (type == "spot") {
        light = spot_light(emitter, scene.origin);
    } else if (type == "directional") {
        light.direction = direction_of(emitter);
        light.intensity = strength_of(emitter, "irradiance");
    } else {
        return false;
    }
    scene.punctual_lights.push_back(light);
    return true;
}

namespace {

/// Years that are accepted. The error of sun_towards() is known for the years from 1999 to 2015.
constexpr float kFirstYear = 1900.0f;
constexpr float kLastYear = 2100.0f;

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
