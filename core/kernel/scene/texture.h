// Images on surfaces: where a point of a triangle lies in them, and their value there.
#pragma once

#include "core/kernel/base/bilinear.h"
#include "core/kernel/base/half.h"
#include "core/kernel/base/span.h"

namespace pl {

/// No image.
inline constexpr std::uint32_t kNoImage = 0xffffffffu;

/// Red, green, blue and opacity as half floats: three digits in 8 bytes, where floats would take 16.
struct alignas(8) Texel {
    std::uint16_t red, green, blue, opacity;
};

PL_HD inline Vec4f unpack(Texel t) {
    return {from_half(t.red), from_half(t.green), from_half(t.blue), from_half(t.opacity)};
}

/// Texels lie row by row from the top, from `first` on in Textures::texels.
struct Image {
    std::uint32_t first;
    std::uint32_t width, height;
    std::uint32_t repeats;  ///< 0: outside of [0, 1] the border goes on
};

/// What each number of a material is multiplied with: indices into Textures::images, or kNoImage.
struct MaterialImages {
    std::uint32_t albedo = kNoImage;
    std::uint32_t roughness = kNoImage;
    std::uint32_t emission = kNoImage;
    std::uint32_t opacity = kNoImage;
    Vec3f emission_scale{1.0f};  ///< one over the image's mean, which is a factor of Material::emission already
};

/// Corners of a triangle in the image plane: indices into Textures::uvs.
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
    std::uint32_t has_holes = 0;             ///< 1: a material has an opacity image
};

/// Image coordinates at barycentric weights of a triangle.
PL_HD inline Vec2f uv_at(const Textures& textures, std::uint32_t primitive, Vec3f b) {
    const TriangleUvs t = textures.triangle_uvs[primitive];
    return b.x * textures.uvs[t.t0] + b.y * textures.uvs[t.t1] + b.z * textures.uvs[t.t2];
}

/// In [0, 1], whatever x is: NaN and what is too large to have a fraction become 0.
PL_HD inline float into_unit(float x, bool repeats) {
    const float inside = repeats ? x - std::floor(x) : clamp_to(x, 0.0f, 1.0f);
    return inside >= 0.0f && inside <= 1.0f ? inside : 0.0f;
}

/// Bilinear between the middles of texels; u runs to the right, v upwards.
PL_HD inline Vec4f sample_image(const Textures& textures, std::uint32_t index, Vec2f uv) {
    const Image& image = textures.images[index];
    const bool repeats = image.repeats != 0;
    const Taps x = taps_at(into_unit(uv.x, repeats), image.width, repeats);
    const Taps y = taps_at(1.0f - into_unit(uv.y, repeats), image.height, repeats);
    const auto at = [&](std::uint32_t column, std::uint32_t row) {
        return unpack(textures.texels[image.first + row * image.width + column]);
    };
    return bilinear(x, y, at(x.low, y.low), at(x.high, y.low), at(x.low, y.high), at(x.high, y.high));
}

/// Below this opacity a surface has a hole.
inline constexpr float kLeastOpacity = 0.5f;

/// Whether rays pass the point at barycentric weights `b` of a triangle of this material.
PL_HD inline bool is_hole(const Textures& textures, std::uint32_t material, std::uint32_t primitive, Vec3f b) {
    const std::uint32_t opacity = textures.of_material[material].opacity;
    return opacity != kNoImage && sample_image(textures, opacity, uv_at(textures, primitive, b)).w < kLeastOpacity;
}

}  // namespace pl
