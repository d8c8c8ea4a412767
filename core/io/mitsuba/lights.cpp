#include "core/io/mitsuba/lights.h"

#include <cmath>
#include <string>

#include <fmt/format.h>

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
    if (const auto given = emitter.point("direction")) local = glm::dvec3(*given);
    const glm::dvec3 direction = glm::dmat3(emitter.transform("to_world")) * local;
    const double length = glm::length(direction);
    if (!(length > 0.0) || !std::isfinite(length)) emitter.fail("expected a direction, got a vector of no length");
    return glm::vec3(direction / length);
}

PunctualLightDescription point_light(const MitsubaObject& emitter) {
    PunctualLightDescription light{.kind = PunctualKind::Point, .intensity = strength_of(emitter, "intensity")};
    const auto given = emitter.point("position");
    light.position = given ? *given : glm::vec3(emitter.transform("to_world")[3]);
    return light;
}

/// Falls off between beam_width and cutoff_angle, linearly over the angle. [Mitsuba 3, spot]
PunctualLightDescription spot_light(const MitsubaObject& emitter) {
    PunctualLightDescription light{.kind = PunctualKind::Spot,
                                   .position = glm::vec3(emitter.transform("to_world")[3]),
                                   .direction = direction_of(emitter),
                                   .intensity = strength_of(emitter, "intensity"),
                                   .falloff = SpotFalloff::Angle};
    light.outer_deg = emitter.number("cutoff_angle").value_or(20.0f);
    light.inner_deg = emitter.number("beam_width").value_or(0.75f * light.outer_deg);
    if (!(light.inner_deg >= 0.0f && light.inner_deg < light.outer_deg && light.outer_deg <= kMostSpotAngle))
        emitter.fail(fmt::format("expected 0 <= beam_width < cutoff_angle <= {}, got {} and {}", kMostSpotAngle,
                                 light.inner_deg, light.outer_deg));
    if (emitter.child("texture")) emitter.note("images that spots project are left out");
    return light;
}

}  // namespace

bool add_mitsuba_light(const MitsubaObject& emitter, SceneDescription& scene) {
    const std::string type = emitter.type();
    PunctualLightDescription light{.kind = PunctualKind::Directional};
    if (type == "point") {
        light = point_light(emitter);
    } else if (type == "spot") {
        light = spot_light(emitter);
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
