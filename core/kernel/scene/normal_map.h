// Normal maps: shading normals from an image. Its red, green and blue are the components of a unit normal along the texture coordinates
// u and v and along the surface's own normal, [-1, 1] as [0, 1].
#pragma once

#include "core/kernel/base/frame.h"
#include "core/kernel/base/numbers.h"
#include "core/kernel/scene/scene_view.h"

namespace pl {

/// Least cosine of a mapped normal with the surface's own one and with the geometric one.
inline constexpr float kLeastMappedCosine = 0.01f;

/// The direction of u on a triangle. [Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., 6.5.2, equation 6.7]
struct TextureAxis {
    Vec3f u{0.0f};      ///< of any length; 0: u does not differ between the corners
    float side = 1.0f;  ///< 1: v is to the left of u; -1: the image is mirrored
};
/// `p0`, `p1`, `p2`: corners of the triangle.
PL_HD inline TextureAxis texture_axis(const Textures& textures, std::uint32_t triangle, Vec3f p0, Vec3f p1,
                                      Vec3f p2) {
    const TriangleUvs corners = textures.triangle_uvs[triangle];
    const Vec2f origin = textures.uvs[corners.t0];
    const Vec2f uv1 = textures.uvs[corners.t1] - origin;
    const Vec2f uv2 = textures.uvs[corners.t2] - origin;
    const float side = uv1.x * uv2.y - uv2.x * uv1.y < 0.0f ? -1.0f : 1.0f;
    const Vec3f dp1 = p1 - p0;
    const Vec3f dp2 = p2 - p0;
    return {side * (uv2.y * dp1 - uv1.y * dp2), side};
}

/// Axes along u and to its left around a unit normal.
struct TangentFrame {
    Frame frame{};
    float side = 0.0f;  ///< TextureAxis::side; 0: u does not differ between the corners
};
PL_HD inline TangentFrame tangent_frame(const TextureAxis& axis, Vec3f normal) {
    const Vec3f tangent = axis.u - glm::dot(axis.u, normal) * normal;
    const float length2 = glm::dot(tangent, tangent);
    if (!(length2 > 0.0f && length2 < kInfinity)) return {};
    const Vec3f x = tangent * (1.0f / std::sqrt(length2));
    return {{x, glm::cross(normal, x), normal}, axis.side};
}

/// Components of the normal that a texel holds, in the TangentFrame; z is positive.
PL_HD inline Vec3f mapped_components(Vec4f texel, const NormalMap& map, float side) {
    const Vec3f n = 2.0f * glm::clamp(Vec3f{texel.x, texel.y, texel.z}, Vec3f{0.0f}, Vec3f{1.0f}) - Vec3f{1.0f};
    return glm::normalize(Vec3f{map.u_strength * n.x, (map.follows_v != 0 ? side : 1.0f) * map.v_strength * n.y,
                                max_of(n.z, kLeastMappedCosine)});
}

/// The nearest normal to `normal`, roughly, whose cosine with `plane_normal` is not below the least one. Both are unit.
PL_HD inline Vec3f above_plane(Vec3f normal, Vec3f plane_normal) {
    const float above = glm::dot(normal, plane_normal);
    if (above >= kLeastMappedCosine) return normal;
    return glm::normalize(normal + (kLeastMappedCosine - above) * plane_normal);
}

PL_HD inline bool has_normal_map(const Textures& textures, std::uint32_t material) {
    return !textures.normal_maps.empty() && textures.normal_maps[material].image != kNoImage;
}

/// A point of a triangle whose material has a normal map.
struct MappedPoint {
    std::uint32_t material;
    std::uint32_t triangle;
    TextureAxis axis;
    Vec3f b;             ///< barycentric weights
    Vec3f plane_normal;  ///< geometric normal of the front side
};

/// The unit shading normal of the front side by the material's normal map; `normal` where the triangle has no texture coordinates.
/// `normal`: the unit normal of the front side without the map.
PL_HD inline Vec3f mapped_normal(const Textures& textures, const MappedPoint& point, Vec3f normal) {
    const TangentFrame tangents = tangent_frame(point.axis, normal);
    if (tangents.side == 0.0f) return normal;
    const NormalMap map = textures.normal_maps[point.material];
    const Vec4f texel = sample_image(textures, map.image, uv_at(textures, point.triangle, point.b));
    const Vec3f mapped = glm::normalize(tangents.frame.to_world(mapped_components(texel, map, tangents.side)));
    return above_plane(mapped, point.plane_normal);
}

/// The shading normal for lobes that reflect towards wo: bent as far as it takes that the mirror direction of wo leaves the surface,
/// since below it all light would be lost. All are unit; wo and `normal` are on the side of `plane_normal`.   [Keller et al. 2017, "The
/// Iray Light Transport Simulation and Rendering System", appendix A.3]
PL_HD inline Vec3f reflecting_normal(Vec3f normal, Vec3f plane_normal, Vec3f wo) {
    const Vec3f mirrored = 2.0f * glm::dot(wo, normal) * normal - wo;
    const float above = glm::dot(mirrored, plane_normal);
    if (above >= kLeastMappedCosine) return normal;
    const Vec3f raised = glm::normalize(mirrored + (kLeastMappedCosine - above) * plane_normal);
    return glm::normalize(wo + raised);
}

}  // namespace pl
