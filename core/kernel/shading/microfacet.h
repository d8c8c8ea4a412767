// GGX: a rough surface as a distribution of tiny mirrors. Directions are local: z is the surface's normal, wo.z > 0.
// [Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces"; Heitz 2014, "Understanding the
// Masking-Shadowing Function"]
#pragma once

#include "core/kernel/base/warp.h"

namespace pl {

struct Ggx {
    float alpha;  ///< width, in (0, 1]

    /// Facets per steradian and projected area: D(m), for m.z > 0.
    PL_HD float density(Vec3f m) const {
        const float a2 = alpha * alpha;
        const float t = (m.x * m.x + m.y * m.y) / a2 + m.z * m.z;
        return kInvPi / (a2 * t * t);
    }
    /// Smith's Lambda of a direction, on either side.
    PL_HD float lambda(Vec3f w) const {
        const float slope2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
        return 0.5f * (std::sqrt(1.0f + alpha * alpha * slope2) - 1.0f);
    }
    /// Share of the facets that both directions see, height correlated.
    PL_HD float visible(Vec3f wo, Vec3f wi) const { return 1.0f / (1.0f + lambda(wo) + lambda(wi)); }
    PL_HD float visible(Vec3f wo) const { return 1.0f / (1.0f + lambda(wo)); }

    /// f cos of facets m, halfway between both, that reflect everything: D G2 / (4 cos_o).
    PL_HD float reflection(Vec3f wo, Vec3f wi, Vec3f m) const { return density(m) * visible(wo, wi) / (4.0f * wo.z); }
    /// Density, per steradian, of wo reflected at m = sample(wo).
    PL_HD float reflection_pdf_sa(Vec3f wo, Vec3f m) const { return visible(wo) * density(m) / (4.0f * wo.z); }
    /// Normal of a facet that wo sees; u in [0,1)^2.   [Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with
    /// Spherical Caps"]
    PL_HD Vec3f sample(Vec3f wo, Vec2f u) const {
        const Vec3f v = glm::normalize(Vec3f{alpha * wo.x, alpha * wo.y, wo.z});
        const Vec2f disk = square_to_disk(u);
        // The disk's direction with its squared radius as the uniform number of the cap's height.
        const float r2 = min_of(disk.x * disk.x + disk.y * disk.y, 1.0f);
        const float z = (1.0f - r2) * (1.0f + v.z) - v.z;
        const float stretch = r2 > 0.0f ? std::sqrt(max_of(1.0f - z * z, 0.0f) / r2) : 0.0f;
        const Vec3f h = Vec3f{disk.x * stretch, disk.y * stretch, z} + v;
        // Directions opposite to v give h = 0: any facet would do, it is seen edge-on.
        const Vec3f m{alpha * h.x, alpha * h.y, max_of(h.z, 1e-7f)};
        return glm::normalize(m);
    }
};

/// Half of the way between two directions on the same side; unit.
PL_HD inline Vec3f half_vector(Vec3f wo, Vec3f wi) { return glm::normalize(wo + wi); }

}  // namespace pl
