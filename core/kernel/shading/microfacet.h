// The GGX (Trowbridge-Reitz) microfacet distribution. Local directions: z is the normal, wo.z > 0.
// [Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces"; Heitz 2014, "Understanding the
// Masking-Shadowing Function"]
#pragma once

#include "core/kernel/base/warp.h"

namespace pl {

/// Microfacets whose width is the same in all directions.
struct IsotropicWidth {
    float alpha;  ///< roughness squared, in (0, 1]

    PL_HD float x() const { return alpha; }
    PL_HD float y() const { return alpha; }
    PL_HD float product() const { return alpha * alpha; }
    /// The square of a normal's y after a stretch across x that gives its facets the width of x, and of a direction's y after the reverse.
    PL_HD static float widened2(float y2) { return y2; }
    PL_HD static float narrowed2(float y2) { return y2; }
};

/// `Width`: IsotropicWidth, or AnisotropicWidth of anisotropy.h.
template <class Width>
struct GgxOf {
    Width width;

    /// D(m), 1/sr: area of the facets with normal m, m.z > 0, per unit surface area.   [Walter et al. 2007, eq. 33]
    PL_HD float density(Vec3f m) const {
        const float t = (m.x * m.x + width.widened2(m.y * m.y)) / (width.x() * width.x()) + m.z * m.z;
        return kInvPi / (width.product() * t * t);
    }
    /// Smith's Lambda of a direction on either side.   [Heitz 2014, eqs. 72, 86]
    PL_HD float lambda(Vec3f w) const {
        const float slope2 = (w.x * w.x + width.narrowed2(w.y * w.y)) / (w.z * w.z);
        return 0.5f * (std::sqrt(1.0f + width.x() * width.x() * slope2) - 1.0f);
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
        const Vec3f v = glm::normalize(Vec3f{width.x() * wo.x, width.y() * wo.y, wo.z});
        const Vec2f disk = square_to_disk(u);
        // Azimuth and squared radius of the disk point serve as the two uniform numbers of the spherical cap.
        const float r2 = min_of(disk.x * disk.x + disk.y * disk.y, 1.0f);
        const float z = (1.0f - r2) * (1.0f + v.z) - v.z;
        const float stretch = r2 > 0.0f ? std::sqrt(max_of(1.0f - z * z, 0.0f) / r2) : 0.0f;
        const Vec3f h = Vec3f{disk.x * stretch, disk.y * stretch, z} + v;
        // h = 0 opposite to v: that facet is seen edge-on, any normal will do.
        const Vec3f m{width.x() * h.x, width.y() * h.y, max_of(h.z, 1e-7f)};
        return glm::normalize(m);
    }
};

using Ggx = GgxOf<IsotropicWidth>;

/// Unit half vector of two directions on the same side.
PL_HD inline Vec3f half_vector(Vec3f wo, Vec3f wi) { return glm::normalize(wo + wi); }

}  // namespace pl
