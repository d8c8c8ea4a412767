// Textures of Mitsuba surfaces as images, and the texture coordinates that they are placed by.
#pragma once

#include <optional>

#include <glm/glm.hpp>

#include "core/io/mitsuba/xml_file.h"
#include "core/scene/description.h"

namespace pl {

/// Index of the image of a `texture` element, added to the scene: a bitmap, or a checkerboard as an image of kCheckerTexels to a side.
/// Empty for other kinds, and for bitmaps that cannot be read, if they are no colors. [Mitsuba 3, bitmap and checkerboard]
std::optional<std::uint32_t> mitsuba_image(const MitsubaObject& texture, TextureContent content,
                                           SceneDescription& scene);
inline constexpr std::uint32_t kCheckerTexels = 128;

/// Index of an image of opacities, the luminance of a bitmap, added to the scene; or kNoTexture. [Mitsuba 3, mask]
std::uint32_t mitsuba_opacities(const MitsubaObject& bitmap, SceneDescription& scene);

/// Index of an image of shares, the luminance of a bitmap or checkerboard, added to the scene; or kNoTexture. [Mitsuba 3, blendbsdf]
std::uint32_t mitsuba_shares(const MitsubaObject& texture, SceneDescription& scene);

/// The transformation of texture coordinates of a `texture` element: `to_uv`, or the scales and offsets of 0.6.
glm::dmat4 mitsuba_to_uv(const MitsubaObject& texture);

/// Heights that displace a surface along its normal, in world units. [Mitsuba 3, bumpmap]
struct MitsubaRelief {
    MitsubaObject texture;  ///< a bitmap
    double scale = 1.0;     ///< of its values
};

/// Transforms the texture coordinates of a material's triangles, in the order of Mitsuba: v downwards in an image.
void transform_uvs(SceneDescription& scene, std::uint32_t material, const glm::dmat4& to_uv);

/// Gives a material the normals of a relief, by the texture coordinates of its triangles. Where their scale varies the mean is taken,
/// with a note.
void add_mitsuba_relief(SceneDescription& scene, std::uint32_t material, const MitsubaRelief& relief);

}  // namespace pl
