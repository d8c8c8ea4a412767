// The isotropic GGX (Trowbridge-Reitz) microfacet distribution. Local directions: z is the normal, wo.z > 0.
// [Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces"; Heitz 2014, "Understanding the
// Masking-Shadowing Function"]
#pragma once

#include "core/kernel/base/warp.h"

namespace pl {

struct Ggx {
    float alpha;  ///< width (roughness squared), in (0, 1]

    /// D(m), 1/sr: area of the facets with normal m, m.z > 0, per unit surface area.   [Walter et al. 2007, eq. 33]
    PL_HD float density(Vec3f m) const {
        const float a2 = alpha * alpha;
        const float t = (m.x * m.x + m.y * m.y) / a2 + m.z * m.z;
        return kInvPi / (a2 * t * t);
    }
    /// Smith's Lambda of a direction on either side.   [Heitz 2014, eq. 72]
    PL_HD float lambda(Vec3f w) const {
        const float slope2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
        return 0.5f * (std::sqrt(1.0f + alpha * alpha * slope2) - 1.0f);
    }
    /// Height-correlated masking-shadowing G2 of two directions, and masking G1 of one.   [Heitz 2014, eqs. 99, 43]
    PL_HD float visible(Vec3f wo, Vec3f wi) const { return 1.0f / (1.0f + lambda(wo) + lambda(wi)); }
    PL_HD float visible(Vec3f wo) const { return 1.0f / (1.0f + lambda(wo)); }

    /// f cos theta_i, 1/sr, for facets with reflectance 1 and m = half_vector(wo, wi): D G2 / (4 cos_o).
    PL_HD float reflection(Vec3f wo, Vec3f wi, Vec3f m) const { return density(m) * visible(wo, wi) / (4.0f * wo.z); }
    /// Density per steradian of wo reflected about m = sample(wo): G1 D / (4 cos_o).
    PL_HD float reflection_pdf_sa(Vec3f wo, Vec3f m) const { return visible(wo) * density(m) / (4.0f * wo.z); }
    /// Samples the normals that are visible from wo; u in [0,1)^2.   [Dupuy and Benyoub 2023, "Sampling Visible GGX
    /// Normals with Spherical Caps"]
    PL_HD Vec3f sample(Vec3f wo, Vec2f u) const {
        const Vec3f v = glm::normalize(Vec3f{alpha * wo.x, alpha * wo.y, wo.z});
        const Vec2f disk = square_to_disk(u);
        // Azimuth and squared radius of the disk point serve as the two uniform numbers of the spherical cap.
        const float r2 = min_of(disk.x * disk.x + disk.y * disk.y, 1.0f);
        const float z = (1.0f - r2) * (1.0f + v.z) - v.z;
        const float stretch = r2 > 0.0f ? std::sqrt(max_of(1.0f - z * z, 0.0f) / r2) : 0.0f;
        const Vec3f h = Vec3f{disk.x * stretch, disk.y * stretch, z} + v;
        // h = 0 opposite to v: that facet is seen edge-on, any normal will do.
        const Vec3f m{alpha * h.x, alpha * h.y, max_of(h.z, 1e-7f)};
        return glm::normalize(m);
    }
};

/// Unit half vector of two directions on the same side.
PL_HD inline Vec3f half_vector(Vec3f wo, Vec3f wi) { return glm::normalize(wo + wi); }

}  // namespace pl
