// Plastic: a Lambert base under a dielectric coat.
#pragma once

#include "core/kernel/shading/directional_albedo.h"
#include "core/kernel/shading/fresnel.h"
#include "core/kernel/shading/microfacet.h"

namespace pl {

/// Local directions, wo.z > 0. The matte lobe is attenuated by the transmittance of the coat for both directions, so
/// the BRDF is reciprocal and a white base conserves energy.   [Kelemen and Szirmay-Kalos 2001, "A Microfacet Based
/// Coupled Specular-Matte BRDF Model with Importance Sampling", eq. 5]
/// A smooth coat (roughness 0) is a delta lobe: eval, pdf_sa and sample then describe the matte lobe alone.
struct Plastic {
    Ggx ggx;
    Vec3f base;      ///< albedo of the base
    Vec3f specular;  ///< tint of the coat's reflection
    float eta;
    AlbedoTable coat;
    float roughness;
    Vec3f wo;
    float coated;  ///< directional albedo of the coat for wo

    PL_HD bool smooth() const { return roughness == 0.0f; }
    PL_HD Vec3f albedo() const { return coated * specular + (1.0f - coated) * base; }

    /// Probability of sampling the coat instead of the base.
    PL_HD float coat_probability() const {
        const float by_coat = coated * max_component(specular);
        const float by_base = (1.0f - coated) * max_component(base);
        return by_coat > 0.0f ? by_coat / (by_coat + by_base) : 0.0f;
    }

    PL_HD Vec3f eval(Vec3f wi) const {
        if (!(wi.z > 0.0f)) return Vec3f{0.0f};
        const float entering =
            (1.0f - coated) * (1.0f - reflected_by_coat(wi.z)) / max_of(1.0f - coat.mean(roughness), 1e-6f);
        const Vec3f matte = base * (entering * wi.z * kInvPi);
        if (smooth()) return matte;
        const Vec3f m = half_vector(wo, wi);
        const float reflectance = fresnel_dielectric(min_of(glm::dot(wo, m), 1.0f), eta);
        return matte + specular * (reflectance * ggx.reflection(wo, wi, m));
    }
    PL_HD float pdf_sa(Vec3f wi) const {
        if (!(wi.z > 0.0f)) return 0.0f;
        const float matte = wi.z * kInvPi;
        if (smooth()) return matte;
        const float p = coat_probability();
        return p * ggx.visible(wo) * ggx.density(half_vector(wo, wi)) / (4.0f * wo.z) + (1.0f - p) * matte;
    }
    PL_HD Vec3f sample(Vec2f u, float choice) const {
        if (smooth() || choice >= coat_probability()) return square_to_cosine_hemisphere(u);
        return reflect_at(wo, ggx.sample(wo, u));
    }

    /// Directional albedo of the coat for any direction.
    PL_HD float reflected_by_coat(float cos_theta) const {
        return smooth() ? fresnel_dielectric(cos_theta, eta) : coat.at(roughness, cos_theta);
    }
};

}  // namespace pl
