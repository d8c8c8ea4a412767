// How much light a smooth interface reflects, and where the rest goes.
#pragma once

#include "core/kernel/base/math.h"

namespace pl {

/// Unpolarized reflectance of a dielectric; `eta` is the index of refraction beyond the interface over that on this side,
/// cos_i in [0, 1]. 1 where all is reflected.   [Born and Wolf, Principles of Optics, 1.5.2]
PL_HD inline float fresnel_dielectric(float cos_i, float eta) {
    const float sin2_t = (1.0f - cos_i * cos_i) / (eta * eta);
    if (sin2_t >= 1.0f) return 1.0f;
    const float cos_t = std::sqrt(1.0f - sin2_t);
    const float parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    const float perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

/// Reflectance of a metal that reflects f0 at normal incidence.   [Schlick 1994, eq. 15]
PL_HD inline Vec3f fresnel_conductor(float cos_i, Vec3f f0) {
    const float m = clamp_to(1.0f - cos_i, 0.0f, 1.0f);
    return f0 + (Vec3f{1.0f} - f0) * (square(square(m)) * m);
}
/// Its mean over directions, weighted with their cosines.
PL_HD inline Vec3f mean_fresnel_conductor(Vec3f f0) { return f0 + (Vec3f{1.0f} - f0) * (1.0f / 21.0f); }

/// wo mirrored at m, both unit.
PL_HD inline Vec3f reflect_at(Vec3f wo, Vec3f m) { return (2.0f * glm::dot(wo, m)) * m - wo; }

/// wo refracted at a facet m with wo.m > 0 by Snell's law; unit. Not to be asked where all is reflected.
PL_HD inline Vec3f refract_at(Vec3f wo, Vec3f m, float eta) {
    const float cos_i = glm::dot(wo, m);
    const float cos_t = safe_sqrt(1.0f - (1.0f - cos_i * cos_i) / (eta * eta));
    return glm::normalize((cos_i / eta - cos_t) * m - wo * (1.0f / eta));
}

}  // namespace pl
