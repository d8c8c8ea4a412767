// Velvet: fibers that stand on a Lambert base and reflect towards the horizon, the sheen of cloth.
#pragma once

#include "core/kernel/shading/directional_albedo.h"
#include "core/kernel/shading/microfacet.h"

namespace pl {

/// The distribution of normals called Charlie, of fibers with reflectance 1.   [Conty Estevez and Kulla 2017, "Production Friendly Microfacet
/// Sheen BRDF"; glTF 2.0, KHR_materials_sheen]
class SheenFibers {
public:
    /// Narrower lobes reflect more light at grazing angles than arrives: roughnesses below it count as this one.
    static constexpr float kLeastRoughness = 0.26f;

    /// `roughness`: root of the alpha of the distribution, above 0.
    PL_HD explicit SheenFibers(float roughness)
        : inverse_alpha_(1.0f / square(roughness)), bend_(square(1.0f - square(roughness))) {}

    /// f cos theta_i, 1/sr: D G / (4 cos_o) for directions above the horizon. Reciprocal except for the cosine.
    PL_HD float reflection(Vec3f wo, Vec3f wi) const {
        const Vec3f m = half_vector(wo, wi);
        return density(m) / ((1.0f + masking(wo.z) + masking(wi.z)) * 4.0f * wo.z);
    }

private:
    static constexpr float kTiny = 1e-30f;  ///< in place of 0 in logarithms

    /// (2 + 1/alpha) sin(theta)^(1/alpha) / (2 pi), per steradian.
    PL_HD float density(Vec3f m) const {
        const float sine2 = clamp_to(m.x * m.x + m.y * m.y, kTiny, 1.0f);
        return (2.0f + inverse_alpha_) * 0.5f * kInvPi * decay_of(-0.5f * inverse_alpha_ * log_of(sine2));
    }
    /// Lambda of Smith's masking, by the authors' fit.
    PL_HD float masking(float cosine) const {
        if (cosine < 0.5f) return exp_of(fit(cosine));
        return exp_of(2.0f * fit(0.5f) - fit(max_of(1.0f - cosine, 0.0f)));
    }
    PL_HD float fit(float x) const {
        const float a = mix(21.5473f, 25.3245f);
        const float b = mix(3.82987f, 3.32435f);
        const float c = mix(0.19823f, 0.16801f);
        const float d = mix(-1.97760f, -1.27393f);
        const float e = mix(-4.32054f, -4.85967f);
        return a / (1.0f + b * exp_of(c * log_of(max_of(x, kTiny)))) + d * x + e;
    }
    PL_HD float mix(float rough, float smooth) const { return rough + (smooth - rough) * bend_; }

    float inverse_alpha_;
    float bend_;  ///< (1 - alpha)^2
};

/// Local directions, wo.z > 0. The base is scaled by what the sheen leaves of the light, the less of both directions: so the BRDF is
/// reciprocal and reflects at most what arrives.   [glTF 2.0, KHR_materials_sheen, "Albedo-scaling technique"]
struct Velvet {
    Vec3f base;            ///< albedo of the base
    Vec3f sheen;           ///< reflectance of the fibers
    float roughness;       ///< at least SheenFibers::kLeastRoughness
    AlbedoTable lossless;  ///< of fibers of reflectance 1
    Vec3f wo;
    float returned;  ///< directional albedo of such fibers for wo

    /// At least the integral of eval(), by up to a sixth: the part of the base is scaled for wo alone.
    PL_HD Vec3f albedo() const { return returned * sheen + left_by_sheen(returned) * base; }

    PL_HD Vec3f eval(Vec3f wi) const {
        if (!(wi.z > 0.0f)) return Vec3f{0.0f};
        const float left = left_by_sheen(max_of(returned, reflected_by_fibers(wi.z)));
        return sheen * SheenFibers(roughness).reflection(wo, wi) + base * (left * wi.z * kInvPi);
    }
    PL_HD float pdf_sa(Vec3f wi) const {
        if (!(wi.z > 0.0f)) return 0.0f;
        const float p = sheen_probability();
        return p * kUniform + (1.0f - p) * wi.z * kInvPi;
    }
    PL_HD Vec3f sample(Vec2f u, float choice) const {
        if (choice >= sheen_probability()) return square_to_cosine_hemisphere(u);
        // Equal areas of the disk's rings are equal heights of the hemisphere.
        const Vec2f disk = square_to_disk(u);
        const float r2 = min_of(disk.x * disk.x + disk.y * disk.y, 1.0f);
        const float outwards = safe_sqrt(2.0f - r2);
        return {disk.x * outwards, disk.y * outwards, 1.0f - r2};
    }

    /// Directional albedo of fibers of reflectance 1 for any direction.
    PL_HD float reflected_by_fibers(float cos_theta) const { return lossless.at(roughness, cos_theta); }

private:
    static constexpr float kUniform = 0.5f * kInvPi;  ///< density of uniform directions

    PL_HD float left_by_sheen(float albedo) const { return 1.0f - max_component(sheen) * albedo; }
    PL_HD float sheen_probability() const {
        const float by_sheen = returned * max_component(sheen);
        const float by_base = left_by_sheen(returned) * max_component(base);
        return by_sheen > 0.0f ? by_sheen / (by_sheen + by_base) : 0.0f;
    }
};

}  // namespace pl
