// Image textures: texture coordinates of a surface point, and bilinear lookup.
#pragma once

#include "core/kernel/base/bilinear.h"
#include "core/kernel/base/half.h"
#include "core/kernel/base/span.h"

namespace pl {

/// No image.
inline constexpr std::uint32_t kNoImage = 0xffffffffu;

/// Red, green, blue and opacity as half floats: 8 bytes.
struct alignas(8) Texel {
    std::uint16_t red, green, blue, opacity;
};

PL_HD inline Vec4f unpack(Texel t) {
    return {from_half(t.red), from_half(t.green), from_half(t.blue), from_half(t.opacity)};
}

/// Texels are stored row by row from the top in Textures::texels, from `first` on.
struct Image {
    std::uint32_t first;
    std::uint32_t width, height;
    std::uint32_t repeats;  ///< 1: coordinates wrap around; 0: they are clamped
};

/// Textures that multiply a material's parameters: indices into Textures::images, or kNoImage.
struct MaterialImages {
    std::uint32_t albedo = kNoImage;
    std::uint32_t roughness = kNoImage;
    std::uint32_t emission = kNoImage;
    Vec3f emission_scale{1.0f};  ///< 1 / mean of the image, because Material::emission includes the mean
};

/// Opacity of a material: `factor`, times the alpha of an image.
struct MaterialOpacity {
    std::uint32_t image = kNoImage;  ///< index into Textures::images, or kNoImage
    float factor = 1.0f;             ///< in [0, 1]
    std::uint32_t blends =
        0;  ///< 1: rays meet the surface with this probability; 0: where it is at least kLeastOpacity
};

/// No other material.
inline constexpr std::uint32_t kNoBlend = 0xffffffffu;

/// Of a material: another one that takes its place with the probability of its share, which may blend itself; see blends.h.
struct MaterialBlend {
    std::uint32_t other = kNoBlend;  ///< index into SceneView::materials, or kNoBlend
    float share = 0.0f;              ///< of the other one, in [0, 1]
    std::uint32_t image = kNoImage;  ///< index into Textures::images: red multiplies the share; or kNoImage
};

/// Of a material: an image of normals, see normal_map.h.
struct NormalMap {
    std::uint32_t image = kNoImage;  ///< index into Textures::images, or kNoImage
    float u_strength = 1.0f;         ///< factor of the slopes along u
    float v_strength = 1.0f;         ///< and along v; negative where green is down
    std::uint32_t follows_v = 1;     ///< 0: green is to the left of u, on mirrored images too
};

/// Texture coordinates of a triangle's corners: indices into Textures::uvs.
struct TriangleUvs {
    std::uint32_t t0, t1, t2;
};

/// All empty unless a material in use has an image.
struct Textures {
    Span<const Vec2f> uvs;
    Span<const TriangleUvs> triangle_uvs;  ///< [triangle]
    Span<const Image> images;
    Span<const Texel> texels;
    Span<const MaterialImages> of_material;  ///< [material]
    Span<const NormalMap> normal_maps;       ///< [material]; empty unless a material in use has one
};

/// Texture coordinates at barycentric weights of a triangle.
PL_HD inline Vec2f uv_at(const Textures& textures, std::uint32_t triangle, Vec3f b) {
    const TriangleUvs t = textures.triangle_uvs[triangle];
    return b.x * textures.uvs[t.t0] + b.y * textures.uvs[t.t1] + b.z * textures.uvs[t.t2];
}

/// Wraps or clamps x to [0, 1]. NaN, and values that are too large to have a fraction, give 0.
PL_HD inline float into_unit(float x, bool repeats) {
    const float inside = repeats ? x - std::floor(x) : clamp_to(x, 0.0f, 1.0f);
    return inside >= 0.0f && inside <= 1.0f ? inside : 0.0f;
}

/// Bilinear lookup between the centers of texels; u to the right, v upwards.
PL_HD inline Vec4f sample_image(const Textures& textures, std::uint32_t index, Vec2f uv) {
    const Image& image = textures.images[index];
    const bool repeats = image.repeats != 0;
    const Taps x = taps_at<One>(into_unit(uv.x, repeats), image.width, repeats);
    const Taps y = taps_at<One>(1.0f - into_unit(uv.y, repeats), image.height, repeats);
    const auto at = [&](std::uint32_t column, std::uint32_t row) {
        return unpack(textures.texels[image.first + row * image.width + column]);
    };
    return bilinear(x, y, at(x.low, y.low), at(x.high, y.low), at(x.low, y.high), at(x.high, y.high));
}

/// A surface that does not blend has a hole where its opacity is below this threshold (alpha test).
inline constexpr float kLeastOpacity = 0.5f;

/// Opacity of a triangle at barycentric weights `b`, in [0, 1]: 0 in a hole, 1 where the surface is solid.
PL_HD inline float opacity_of(const Textures& textures, const MaterialOpacity& material, std::uint32_t triangle,
                              Vec3f b) {
    float opacity = material.factor;
    if (material.image != kNoImage) opacity *= sample_image(textures, material.image, uv_at(textures, triangle, b)).w;
    if (material.blends != 0) return opacity;
    return opacity < kLeastOpacity ? 0.0f : 1.0f;
}

}  // namespace pl
