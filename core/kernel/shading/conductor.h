// Conductors: a mirror, or GGX with compensation for multiple scattering.
#pragma once

#include "core/kernel/shading/directional_albedo.h"
#include "core/kernel/shading/fresnel.h"
#include "core/kernel/shading/microfacet.h"

namespace pl {

/// Local directions, wo.z > 0. Single scattering by [Walter et al. 2007]; multiple scattering by a reciprocal lobe
/// that restores the missing energy, all of it if the facets absorb nothing.   [Kulla and Conty 2017, "Revisiting
/// Physically Based Shading at Imageworks"; Turquin 2019 for its tint]
template <class Width>
struct RoughConductor {
    GgxOf<Width> ggx;
    Vec3f f0;         ///< reflectance at normal incidence
    Vec3f edge_loss;  ///< see fresnel_conductor()
    AlbedoTable lossless;
    float roughness;  ///< for the table
    Vec3f wo;
    float returned;  ///< lossless.at(roughness, wo.z)

    /// Directional albedo for wo.
    PL_HD Vec3f albedo() const {
        const Vec3f single = fresnel_conductor(wo.z, f0, edge_loss) * returned;
        return single + (1.0f - returned) * several_tint();
    }

    /// f cos theta_i, 1/sr.
    PL_HD Vec3f eval(Vec3f wi) const {
        if (!(wi.z > 0.0f)) return Vec3f{0.0f};
        const Vec3f m = half_vector(wo, wi);
        const Vec3f single = fresnel_conductor(glm::dot(wo, m), f0, edge_loss) * ggx.reflection(wo, wi, m);
        const float missing = max_of(1.0f - lossless.mean(roughness), 1e-6f);
        const float several = (1.0f - returned) * (1.0f - lossless.at(roughness, wi.z)) / missing;
        return single + several_tint() * (several * wi.z * kInvPi);
    }
    PL_HD float pdf_sa(Vec3f wi) const {
        if (!(wi.z > 0.0f)) return 0.0f;
        return returned * ggx.reflection_pdf_sa(wo, half_vector(wo, wi)) + (1.0f - returned) * wi.z * kInvPi;
    }
    /// A unit direction, which may be below the horizon; `choice` in [0, 1) selects one of the two lobes.
    PL_HD Vec3f sample(Vec2f u, float choice) const {
        if (choice >= returned) return square_to_cosine_hemisphere(u);
        return reflect_at(wo, ggx.sample(wo, u));
    }

private:
    PL_HD Vec3f several_tint() const {
        const Vec3f f = mean_fresnel_conductor(f0, edge_loss);
        const float mean = lossless.mean(roughness);
        return f * f * mean / (Vec3f{1.0f} - f * (1.0f - mean));
    }
};

}  // namespace pl
