#include "core/io/mitsuba/lights.h"

#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

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

/// Along +z of the place, or 'direction', which it turns.
glm::vec3 direction_of(const MitsubaObject& emitter) {
    glm::dvec3 local(0.0, 0.0, 1.0);
    if (const auto given = emitter.point("direction")) local = *given;
    const glm::dvec3 direction = glm::dmat3(emitter.transform("to_world")) * local;
    const double length = glm::length(direction);
    if (!(length > 0.0) || !std::isfinite(length)) emitter.fail("expected a direction, got a vector of no length");
    return glm::vec3(direction / length);
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

}  // namespace pl
