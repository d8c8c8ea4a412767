// Fresnel reflectance, reflection and refraction at a smooth interface.
#pragma once

#include "core/kernel/base/math.h"

namespace pl {

/// Unpolarized Fresnel reflectance of a dielectric; `eta` is the index of refraction of the far side over that of the
/// near side, cos_i in [0, 1]. 1 under total internal reflection.   [Born and Wolf, Principles of Optics, 1.5.2]
PL_HD inline float fresnel_dielectric(float cos_i, float eta) {
    const float sin2_t = (1.0f - cos_i * cos_i) / (eta * eta);
    if (sin2_t >= 1.0f) return 1.0f;
    const float cos_t = std::sqrt(1.0f - sin2_t);
    const float parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    const float perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

/// Schlick's approximation for a conductor with reflectance f0 at normal incidence.   [Schlick 1994, eq. 15]
PL_HD inline Vec3f fresnel_conductor(float cos_i, Vec3f f0) {
    const float m = clamp_to(1.0f - cos_i, 0.0f, 1.0f);
    return f0 + (Vec3f{1.0f} - f0) * (square(square(m)) * m);
}
/// Cosine-weighted mean of fresnel_conductor() over the hemisphere.
PL_HD inline Vec3f mean_fresnel_conductor(Vec3f f0) { return f0 + (Vec3f{1.0f} - f0) * (1.0f / 21.0f); }

/// wo reflected about m, both unit.
PL_HD inline Vec3f reflect_at(Vec3f wo, Vec3f m) { return (2.0f * glm::dot(wo, m)) * m - wo; }

/// wo refracted at a facet m with wo.m > 0 by Snell's law; unit. Precondition: no total internal reflection.
PL_HD inline Vec3f refract_at(Vec3f wo, Vec3f m, float eta) {
    const float cos_i = glm::dot(wo, m);
    const float cos_t = safe_sqrt(1.0f - (1.0f - cos_i * cos_i) / (eta * eta));
    return glm::normalize((cos_i / eta - cos_t) * m - wo * (1.0f / eta));
}

}  // namespace pl
