// Fresnel reflectance, reflection and refraction at a smooth interface.
#pragma once

#include "core/kernel/base/math.h"

namespace pl {

/// Unpolarized Fresnel reflectance of a dielectric; `eta` is the index of refraction of the far side over the index
/// of the near side, cos_i in [0, 1]. 1 under total internal reflection.   [Born and Wolf, Principles of Optics,
/// 1.5.2]
PL_HD inline float fresnel_dielectric(float cos_i, float eta) {
    const float sin2_t = (1.0f - cos_i * cos_i) / (eta * eta);
    if (sin2_t >= 1.0f) return 1.0f;
    const float cos_t = std::sqrt(1.0f - sin2_t);
    const float parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    const float perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

/// Reflectance of a sheet of clear glass between whose faces light goes to and fro: R + (1 - R)^2 R / (1 - R^2).   [Born and Wolf,
/// Principles of Optics, 7.6, without interference]
PL_HD inline float fresnel_pane(float cos_i, float eta) {
    const float face = fresnel_dielectric(cos_i, eta);
    return 2.0f * face / (1.0f + face);
}

/// Unpolarized Fresnel reflectance of a conductor with the complex index of refraction eta + i k, relative to the
/// near side.   [Born and Wolf, Principles of Optics, 14.2]
PL_HD inline float fresnel_complex(float cos_i, float eta, float k) {
    const float cos2 = cos_i * cos_i;
    const float sin2 = 1.0f - cos2;
    const float real = eta * eta - k * k - sin2;
    const float length = std::sqrt(real * real + 4.0f * eta * eta * k * k);  // a^2 + b^2
    const float a_cos = 2.0f * cos_i * safe_sqrt(0.5f * (length + real));
    const float perpendicular = (length + cos2 - a_cos) / (length + cos2 + a_cos);
    const float steep = cos2 * length + sin2 * sin2;
    const float parallel = perpendicular * (steep - a_cos * sin2) / (steep + a_cos * sin2);
    return 0.5f * (perpendicular + parallel);
}

/// A conductor's reflectance f0 at normal incidence, rising to 1 by Schlick's approximation, less a loss that is greatest near 82
/// degrees.   [Schlick 1994, eq. 15; Lazanyi and Szirmay-Kalos 2005, "Fresnel Term Approximations for Metals", with the exponent of Kutz,
/// Hasan and Edmondson 2021, "Novel aspects of the Adobe Standard Material"]
PL_HD inline Vec3f fresnel_conductor(float cos_i, Vec3f f0, Vec3f edge_loss) {
    const float m = clamp_to(1.0f - cos_i, 0.0f, 1.0f);
    const float m2 = square(m);
    const Vec3f schlick = f0 + (Vec3f{1.0f} - f0) * (square(m2) * m);
    return glm::max(schlick - edge_loss * ((1.0f - m) * square(m2) * m2), Vec3f{0.0f});
}
/// Cosine-weighted mean of fresnel_conductor() over the hemisphere.
PL_HD inline Vec3f mean_fresnel_conductor(Vec3f f0, Vec3f edge_loss) {
    return glm::max(f0 + (Vec3f{1.0f} - f0) * (1.0f / 21.0f) - edge_loss * (1.0f / 126.0f), Vec3f{0.0f});
}

/// The angle at which an edge tint is told: cos = 1/7, 82 degrees.
inline constexpr float kEdgeCosine = 1.0f / 7.0f;

/// The loss by which fresnel_conductor() is `tint` times Schlick's approximation at kEdgeCosine; 0 for a tint of 1.
PL_HD inline Vec3f edge_loss_of(Vec3f f0, Vec3f tint) {
    constexpr float m = 1.0f - kEdgeCosine;
    constexpr float m5 = m * m * m * m * m;
    return (f0 + (Vec3f{1.0f} - f0) * m5) * (Vec3f{1.0f} - tint) * (1.0f / (kEdgeCosine * m5 * m));
}

/// wo reflected about m, both unit.
PL_HD inline Vec3f reflect_at(Vec3f wo, Vec3f m) { return (2.0f * glm::dot(wo, m)) * m - wo; }

/// wo refracted at a facet m with wo.m > 0 by Snell's law; unit. Precondition: no total internal reflection.
PL_HD inline Vec3f refract_at(Vec3f wo, Vec3f m, float eta) {
    const float cos_i = glm::dot(wo, m);
    const float cos_t = safe_sqrt(1.0f - (1.0f - cos_i * cos_i) / (eta * eta));
    return glm::normalize((cos_i / eta - cos_t) * m - wo * (1.0f / eta));
}

}  // namespace pl
