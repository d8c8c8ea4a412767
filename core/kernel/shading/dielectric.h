// Dielectrics: reflection and refraction by a smooth interface, or by GGX facets.
#pragma once

#include "core/kernel/shading/directional_albedo.h"
#include "core/kernel/shading/fresnel.h"
#include "core/kernel/shading/microfacet.h"

namespace pl {

/// Rough dielectric; local directions, wo.z > 0, transmission for wi.z < 0. Paths transport radiance from light to
/// camera: transmission includes the factor 1 / eta^2.   [Walter et al. 2007, eqs. 20, 21; Veach 1997, 5.2 for eta^2]
/// The BSDF is divided by its directional albedo for single scattering, so that a lossless dielectric keeps all
/// energy [Turquin 2019, "Practical Multiple Scattering Compensation for Microfacet Models"]; the factor depends on
/// wo alone, so the BSDF is not reciprocal.
struct RoughDielectric {
    Ggx ggx;
    float eta;  ///< relative index of refraction: far side over the side of wo
    Vec3f specular, transmission;
    Vec3f wo;
    float returned;  ///< directional albedo for wo by single scattering

    PL_HD Vec3f eval(Vec3f wi) const {
        const Facet facet = facet_between(wi);
        if (!facet.usable) return Vec3f{0.0f};
        const float common = ggx.density(facet.m) * ggx.visible(wo, wi) / (wo.z * returned);
        if (wi.z > 0.0f) return specular * (facet.reflectance * common * 0.25f);
        return transmission * ((1.0f - facet.reflectance) * common * facet.cos_o * facet.cos_i /
                               square(facet.cos_o - eta * facet.cos_i));
    }
    PL_HD float pdf_sa(Vec3f wi) const {
        const Facet facet = facet_between(wi);
        if (!facet.usable) return 0.0f;
        const float common = ggx.density(facet.m) * ggx.visible(wo) / wo.z;
        if (wi.z > 0.0f) return facet.reflectance * common * 0.25f;
        return (1.0f - facet.reflectance) * common * facet.cos_o * facet.cos_i *
               square(eta / (facet.cos_o - eta * facet.cos_i));
    }
    /// A unit direction, reflected if `choice` in [0, 1) is below the facet's Fresnel reflectance, else refracted. 0,
    /// a sample of value 0, if it lies on the wrong side of the surface.
    PL_HD Vec3f sample(Vec2f u, float choice) const {
        const Vec3f m = ggx.sample(wo, u);
        const bool reflects = choice < fresnel_dielectric(clamp_to(glm::dot(wo, m), 0.0f, 1.0f), eta);
        const Vec3f wi = reflects ? reflect_at(wo, m) : refract_at(wo, m, eta);
        return reflects == (wi.z > 0.0f) ? wi : Vec3f{0.0f};
    }

private:
    /// The facet that scatters wo into wi: the (generalized) half vector.
    struct Facet {
        Vec3f m{0.0f, 0.0f, 1.0f};
        float cos_o = 0.0f;  ///< wo.m, above 0
        float cos_i = 0.0f;  ///< |wi.m|
        float reflectance = 0.0f;
        bool usable = false;
    };
    PL_HD Facet facet_between(Vec3f wi) const {
        if (wi.z == 0.0f) return {};
        Vec3f m = wi.z > 0.0f ? wo + wi : wo + eta * wi;
        const float length2 = glm::dot(m, m);
        if (!(length2 > 0.0f)) return {};
        m *= (m.z >= 0.0f ? 1.0f : -1.0f) / std::sqrt(length2);
        const float cos_o = glm::dot(wo, m);
        const float cos_i = glm::dot(wi, m);
        // Back-facing facets do not scatter: a facet and the surface show a direction the same side.
        if (!(cos_o > 0.0f) || !(cos_i * wi.z > 0.0f)) return {};
        return {m, cos_o, std::fabs(cos_i), fresnel_dielectric(min_of(cos_o, 1.0f), eta), true};
    }
};

}  // namespace pl
