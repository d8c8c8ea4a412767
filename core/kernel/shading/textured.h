// Material parameters at a surface point, with textures applied. `b` are the barycentric weights of the point.
#pragma once

#include "core/kernel/base/features.h"
#include "core/kernel/scene/surface_point.h"
#include "core/kernel/shading/blends.h"

namespace pl {

/// Lower bound on textured roughness: at 0 the lobe would become a delta lobe.
inline constexpr float kLeastTexturedRoughness = 0.03f;

/// The material that a surface shows towards wo, at barycentric weights `b`: its own unless it blends.
template <FeatureSet F>
PL_HD inline MaterialPoint shown_material(const SceneView& scene, const SurfacePoint& surface, Vec3f b, Vec3f wo) {
    MaterialPoint point{surface.material, surface.primitive, triangle_of<F>(scene, surface.primitive), b};
    if constexpr (F.has(Feature::Blends)) {
        if (!scene.blends.empty()) point.material = blended_material(scene, point, wo);
    }
    return point;
}

PL_HD inline Vec3f color_of(Vec4f texel) { return {texel.x, texel.y, texel.z}; }

/// Colors of a triangle's vertices, interpolated.
PL_HD inline Vec3f vertex_color_at(const SceneView& scene, std::uint32_t triangle, Vec3f b) {
    const Triangle corners = scene.triangles[triangle];
    return b.x * scene.vertex_colors[corners.v0] + b.y * scene.vertex_colors[corners.v1] +
           b.z * scene.vertex_colors[corners.v2];
}

/// Value of the albedo texture times the colors of the vertices, at most 1 per channel; white without either.
template <FeatureSet F>
PL_HD inline Vec3f tint_at(const SceneView& scene, const MaterialPoint& point) {
    Vec3f tint{1.0f};
    if constexpr (F.has(Feature::Textures)) {
        if (!scene.textures.of_material.empty()) {
            const std::uint32_t image = scene.textures.of_material[point.material].albedo;
            if (image != kNoImage) {
                const Vec2f uv = uv_at(scene.textures, point.triangle, point.b);
                tint = glm::min(color_of(sample_image(scene.textures, image, uv)), Vec3f{1.0f});
            }
        }
        if (!scene.vertex_colors.empty())
            tint *= glm::min(vertex_color_at(scene, point.triangle, point.b), Vec3f{1.0f});
    }
    return tint;
}

/// Albedo of the diffuse, or guided, lobe.
template <FeatureSet F>
PL_HD inline Vec3f albedo_at(const SceneView& scene, const MaterialPoint& point) {
    const Vec3f albedo = scene.materials[point.material].albedo;
    if constexpr (F.has(Feature::Textures)) return albedo * tint_at<F>(scene, point);
    return albedo;
}

/// Parameters of lobes whose material may have images of them.
template <FeatureSet F>
PL_HOST_APART PL_HD inline SurfaceLobes lobes_by_image(const SceneView& scene, const MaterialPoint& point,
                                                       SurfaceLobes lobes) {
    if (lobes.kind == SurfaceKind::Conductor) lobes.specular *= tint_at<F>(scene, point);
    if (!scene.textures.of_material.empty()) {
        const std::uint32_t image = scene.textures.of_material[point.material].roughness;
        if (image != kNoImage) {
            const Vec2f uv = uv_at(scene.textures, point.triangle, point.b);
            const float share = sample_image(scene.textures, image, uv).x;
            lobes.roughness = clamp_to(lobes.roughness * share, kLeastTexturedRoughness, 1.0f);
        }
    }
    return lobes;
}

/// Parameters of the other lobes. SceneView::lobes must not be empty.
template <FeatureSet F>
PL_HD inline SurfaceLobes lobes_at(const SceneView& scene, const MaterialPoint& point) {
    const SurfaceLobes lobes = scene.lobes[point.material];
    if constexpr (F.has(Feature::Textures)) {
        if (lobes.kind != SurfaceKind::Diffuse) return lobes_by_image<F>(scene, point, lobes);
    }
    return lobes;
}

/// Emitted radiance of a surface whose material may have an image of it.
template <FeatureSet F>
PL_HOST_APART PL_HD inline Vec3f emission_by_image(const SceneView& scene, const SurfacePoint& surface, Vec3f b,
                                                   Vec3f emitted) {
    const MaterialImages& images = scene.textures.of_material[surface.material];
    if (images.emission == kNoImage) return emitted;
    const Vec2f uv = uv_at(scene.textures, triangle_of<F>(scene, surface.primitive), b);
    return emitted * (images.emission_scale * color_of(sample_image(scene.textures, images.emission, uv)));
}

/// Emitted radiance towards wo.
template <FeatureSet F>
PL_HD inline Vec3f emitted_at(const SceneView& scene, const SurfacePoint& surface, Vec3f b) {
    const Vec3f emitted = emitted_radiance(scene.materials[surface.material], surface.front);
    if constexpr (F.has(Feature::Textures)) {
        if (!scene.textures.of_material.empty() && !is_black(emitted))
            return emission_by_image<F>(scene, surface, b, emitted);
    }
    return emitted;
}

/// Probability that a ray meets the triangle at `b`.
template <FeatureSet F>
PL_HD inline float opacity_at(const SceneView& scene, std::uint32_t primitive, Vec3f b) {
    if constexpr (F.has(Feature::CutOuts)) {
        if (!scene.opacities.empty()) {
            const std::uint32_t triangle = triangle_of<F>(scene, primitive);
            return opacity_of(scene.textures, scene.opacities[scene.triangles[triangle].material], triangle, b);
        }
    }
    return 1.0f;
}

}  // namespace pl
