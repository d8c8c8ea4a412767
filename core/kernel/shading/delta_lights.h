// Lights without extent: points, spots, and infinitely distant ones of a single direction. No path hits them, so light samples alone
// bring their light.
#pragma once

#include <cstdint>

#include "core/kernel/base/angles.h"
#include "core/kernel/base/math.h"
#include "core/kernel/base/span.h"

namespace pl {

enum class DeltaLightKind : std::uint32_t {
    Point,
    Directional,
    CosineSpot,  ///< falls off by the square of a linear function of the cosine   [glTF 2.0, KHR_lights_punctual]
    AngleSpot,   ///< falls off by a linear function of the angle   [Mitsuba 3, spot]
};

/// Aligned, so that a device reads it by 16 bytes.
struct alignas(16) DeltaLight {
    /// Radiant intensity, W/sr, of a spot on its axis; of a directional light the irradiance of a surface that faces it, W/m^2.
    Vec3f intensity{0.0f};
    DeltaLightKind kind = DeltaLightKind::Point;
    Vec3f position{0.0f};
    float slope = 0.0f;  ///< of a spot's falloff over the cosine, or the angle in radians, between axis and direction
    Vec3f axis{0.0f, 0.0f, 1.0f};  ///< unit, in which the light of spots and directional lights travels
    float offset = 1.0f;           ///< of the falloff
};
static_assert(sizeof(DeltaLight) == 48);

/// Light that reaches a point from a delta light.
struct DeltaIllumination {
    Vec3f wi{0.0f};          ///< unit, towards the light
    Vec3f irradiance{0.0f};  ///< of a surface that faces the light, W/m^2
};

/// Share of a spot's intensity in a unit direction away from it: 1 inside of the inner cone, 0 outside of the outer one.
PL_HD inline float spot_falloff(const DeltaLight& light, Vec3f direction) {
    const float cosine = glm::dot(light.axis, direction);
    if (light.kind == DeltaLightKind::CosineSpot) {
        const float share = clamp_to(cosine * light.slope + light.offset, 0.0f, 1.0f);
        return share * share;
    }
    // The cross product is exact where the cosine is flat.
    const float sine = glm::length(glm::cross(light.axis, direction));
    const float angle = (2.0f * kPi) * turns_of(sine, cosine);
    return clamp_to(angle * light.slope + light.offset, 0.0f, 1.0f);
}

/// Nothing occludes the light; a point in the place of the light receives nothing.
PL_HD inline DeltaIllumination illuminate(const DeltaLight& light, Vec3f point) {
    if (light.kind == DeltaLightKind::Directional) return {-light.axis, light.intensity};
    const Vec3f segment = light.position - point;
    const float distance2 = glm::dot(segment, segment);
    if (!(distance2 > 0.0f)) return {};
    const Vec3f wi = segment * (1.0f / std::sqrt(distance2));
    const float share = light.kind == DeltaLightKind::Point ? 1.0f : spot_falloff(light, -wi);
    return {wi, light.intensity * (share / distance2)};
}

/// Most delta lights that a light sample compares.
inline constexpr std::uint32_t kMostComparedLights = 32;

/// A delta light counts as a light of this inverse solid angle, 1/sr: its light samples have radiance and density
/// like others. Next to such densities the densities of directions vanish, so that the weight of the light by
/// multiple importance sampling is exactly 1. A power of two, which rounds nothing.
inline constexpr float kDeltaDensity = 0x1p60f;

/// The target of shadow rays to the position of a delta light: no triangle.
inline constexpr std::uint32_t kDeltaLightTarget = 0xfffffffeu;

}  // namespace pl
