// Anisotropy: facets of rough metals that spread more along one direction of the surface than across it, as brushing leaves them.
#pragma once

#include "core/kernel/scene/normal_map.h"
#include "core/kernel/scene/surface_point.h"
#include "core/kernel/shading/microfacet.h"

namespace pl {

/// Widths along x and y, for GgxOf. A ratio of 1 has the bits of IsotropicWidth.   [Heitz 2014, eqs. 80, 85]
struct AnisotropicWidth {
    float alpha;  ///< along x
    float ratio;  ///< of the width along y to the width along x, in (0, 1]

    PL_HD float x() const { return alpha; }
    PL_HD float y() const { return alpha * ratio; }
    PL_HD float product() const { return alpha * alpha * ratio; }
    PL_HD float widened2(float y2) const { return y2 / (ratio * ratio); }
    PL_HD float narrowed2(float y2) const { return y2 * (ratio * ratio); }
};

/// The facets of a LayeredBsdf that may be anisotropic.
class AnisotropicFacets {
public:
    /// The anisotropy of a material with its directions at a surface point.
    struct Grain {
        MaterialAnisotropy material{};
        TextureAxis axis{};  ///< unused unless the ratio is below 1
        bool front = true;
    };
    using Width = AnisotropicWidth;

    AnisotropicFacets() = default;
    PL_HD explicit AnisotropicFacets(const Grain& grain)
        : stretch_(grain.material.stretch), ratio_(grain.material.ratio),
          table_stretch_(grain.material.table_stretch) {}

    PL_HD GgxOf<AnisotropicWidth> ggx(float roughness) const { return {{square(roughness) * stretch_, ratio_}}; }
    /// The roughness of the isotropic facets whose table of albedos serves.
    PL_HD float table_roughness(float roughness) const { return roughness * table_stretch_; }
    /// Around the unit normal of the side that is seen. x is the direction in which the facets spread most: the
    /// direction of u, turned towards v.
    static PL_HD Frame frame(const Grain& grain, Vec3f normal) {
        if (grain.material.ratio == 1.0f) return make_frame(normal);
        const float side = grain.front ? 1.0f : -1.0f;
        const TangentFrame tangents = tangent_frame(grain.axis, normal);
        const bool has_u = tangents.side != 0.0f;
        const Vec3f u = has_u ? tangents.frame.x : make_frame(side * normal).x;
        const float turn = grain.material.sine * side * (has_u ? tangents.side : 1.0f);
        const Vec3f x = grain.material.cosine * u + turn * glm::cross(normal, u);
        return {x, glm::cross(normal, x), normal};
    }

private:
    float stretch_ = 1.0f;
    float ratio_ = 1.0f;
    float table_stretch_ = 1.0f;
};

/// SceneView::anisotropies must not be empty.
template <FeatureSet F>
PL_HD inline AnisotropicFacets::Grain grain_of(const SceneView& scene, const SurfacePoint& surface,
                                               std::uint32_t material) {
    const MaterialAnisotropy anisotropy = scene.anisotropies[material];
    if (anisotropy.ratio == 1.0f) return {};
    return {anisotropy, texture_axis<F>(scene, surface.primitive), surface.front};
}

}  // namespace pl
