#include "core/scene/pack_steps.h"

#include <algorithm>
#include <vector>

#include "core/scene/anisotropy.h"
#include "core/scene/surface_info.h"

namespace pl {
namespace {

Texel pack_texel(const glm::vec4& t) { return {to_half(t.x), to_half(t.y), to_half(t.z), to_half(t.w)}; }

/// Mean of the texels after rounding to half floats, as kernels read them.
Vec3f mean_of(const TextureDescription& texture) {
    Vec3d sum{0.0};
    for (const glm::vec4& texel : texture.texels) sum += Vec3d{Vec3f{unpack(pack_texel(texel))}};
    return Vec3f{sum / static_cast<double>(texture.texels.size())};
}

/// Least opacity of an image, as kernels read it.
float least_opacity(const TextureDescription& texture) {
    float least = 1.0f;
    for (const glm::vec4& texel : texture.texels) least = std::min(least, unpack(pack_texel(texel)).w);
    return least;
}

float inverse_or_zero(float x) { return x > 0.0f ? 1.0f / x : 0.0f; }

/// The color that an albedo texture multiplies.
Vec3f tinted(const MaterialDescription& material) {
    return is_glass(material.kind) ? Vec3f{0.0f} : Vec3f{material.*surface_info(material.kind).color};
}

class ImagePacker {
public:
    ImagePacker(const SceneDescription& scene, HostScene& packed)
        : scene_(scene), packed_(packed), image_of_(scene.textures.size(), kNoImage) {}

    /// `is_rough`: as it is packed, which has a table of albedos.
    MaterialImages pack(const MaterialDescription& material, bool is_rough, Material& packed_material) {
        MaterialImages images;
        const TextureUse& use = material.textures;
        if (use.albedo != kNoTexture && !is_black(tinted(material))) images.albedo = image(use.albedo);
        if (use.roughness != kNoTexture && is_rough) images.roughness = image(use.roughness);
        if (use.emission != kNoTexture && packed_material.emits()) {
            const Vec3f mean = mean_of(scene_.textures[use.emission]);
            packed_material.emission *= mean;
            images.emission_scale = {inverse_or_zero(mean.x), inverse_or_zero(mean.y), inverse_or_zero(mean.z)};
            if (packed_material.emits()) images.emission = image(use.emission);
        }
        return images;
    }

    /// The standard, which is opaque, unless some ray may pass.
    MaterialOpacity pack_opacity(const MaterialDescription& material) {
        const std::uint32_t texture = material.textures.opacity;
        const bool blends = material.opacity_rule == OpacityRule::Blend;
        const float of_image = texture == kNoTexture ? 1.0f : least_opacity(scene_.textures[texture]);
        if (material.opacity * of_image >= (blends ? 1.0f : kLeastOpacity)) return {};
        return {of_image < 1.0f ? image(texture) : kNoImage, material.opacity, blends ? 1u : 0u};
    }

    /// The standard, which does not blend, unless some ray may meet the other material.
    MaterialBlend pack_blend(const MaterialDescription& material) {
        const auto& [other, share] = material.blend;
        if (other == kNoMaterial || share == 0.0f) return {};
        const std::uint32_t texture = material.textures.blend;
        return {other, share, texture == kNoTexture ? kNoImage : image(texture)};
    }

    NormalMap pack_normals(const MaterialDescription& material) {
        if (material.textures.normal == kNoTexture || material.normal_strength == 0.0f) return {};
        const float strength = material.normal_strength;
        return {image(material.textures.normal), strength,
                material.normal_green == NormalGreen::Down ? -strength : strength,
                material.normal_green == NormalGreen::Left ? 0u : 1u};
    }

private:
    /// Index of the packed image of a texture; each is packed once.
    std::uint32_t image(std::uint32_t texture) {
        std::uint32_t& index = image_of_[texture];
        if (index != kNoImage) return index;
        const TextureDescription& from = scene_.textures[texture];
        index = static_cast<std::uint32_t>(packed_.images.size());
        packed_.images.push_back(
            {static_cast<std::uint32_t>(packed_.texels.size()), from.width, from.height, from.repeats ? 1u : 0u});
        packed_.texels.reserve(packed_.texels.size() + from.texels.size());
        for (const glm::vec4& texel : from.texels) packed_.texels.push_back(pack_texel(texel));
        return index;
    }

    const SceneDescription& scene_;
    HostScene& packed_;
    std::vector<std::uint32_t> image_of_;
};

/// Materials that paths meet: the materials of triangles, and the materials that these blend with.
struct Uses {
    std::vector<bool> on_triangles;
    std::vector<bool> shown;

    explicit Uses(const SceneDescription& scene) : on_triangles(scene.materials.size(), false) {
        for (const TriangleDescription& t : scene.triangles) on_triangles[t.material] = true;
        shown = on_triangles;
        for (std::size_t m = 0; m < shown.size(); ++m) {
            if (!on_triangles[m]) continue;
            for (std::uint32_t other = scene.materials[m].blend.other; other != kNoMaterial;
                 other = scene.materials[other].blend.other)
                shown[other] = true;
        }
    }
};

/// Nothing unless a material in use is anisotropic.
void pack_anisotropies(const SceneDescription& scene, const Uses& uses, HostScene& packed) {
    std::vector<MaterialAnisotropy> all(scene.materials.size());
    bool any = false;
    for (std::size_t m = 0; m < all.size(); ++m) {
        if (!uses.shown[m] || !scene.materials[m].is_anisotropic()) continue;
        all[m] = pack_anisotropy(scene.materials[m].anisotropy, scene.materials[m].rotation_deg);
        any = true;
    }
    if (any) packed.anisotropies = std::move(all);
}

void pack_uvs(const SceneDescription& scene, HostScene& packed) {
    packed.uvs = scene.uvs;
    const auto origin = static_cast<std::uint32_t>(packed.uvs.size());
    packed.uvs.emplace_back(0.0f);
    packed.triangle_uvs.reserve(scene.triangles.size());
    for (const TriangleDescription& t : scene.triangles) {
        const glm::uvec3 uv = t.has_uvs() ? t.uv : glm::uvec3{origin};
        packed.triangle_uvs.push_back({uv.x, uv.y, uv.z});
    }
}

}  // namespace

void pack_textures(const SceneDescription& scene, HostScene& packed) {
    const Uses uses(scene);
    ImagePacker packer(scene, packed);
    std::vector<MaterialImages> of_material(scene.materials.size());
    std::vector<NormalMap> normal_maps(scene.materials.size());
    std::vector<MaterialOpacity> opacities(scene.materials.size());
    std::vector<MaterialBlend> blends(scene.materials.size());
    bool has_normals = false;
    bool has_holes = false;
    bool has_blends = false;
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        if (!uses.shown[m]) continue;
        blends[m] = packer.pack_blend(scene.materials[m]);
        has_blends = has_blends || blends[m].other != kNoBlend;
        if (uses.on_triangles[m]) opacities[m] = packer.pack_opacity(scene.materials[m]);
        has_holes = has_holes || opacities[m].image != kNoImage || opacities[m].factor < 1.0f;
        if (!scene.materials[m].textures.any()) continue;
        const bool is_rough = !packed.lobes.empty() && packed.lobes[m].roughness > 0.0f;
        of_material[m] = packer.pack(scene.materials[m], is_rough, packed.materials[m]);
        if (uses.on_triangles[m]) normal_maps[m] = packer.pack_normals(scene.materials[m]);
        has_normals = has_normals || normal_maps[m].image != kNoImage;
    }
    if (has_holes) packed.opacities = std::move(opacities);
    if (has_blends) packed.blends = std::move(blends);
    pack_anisotropies(scene, uses, packed);
    if (packed.images.empty() && packed.anisotropies.empty()) return;
    pack_uvs(scene, packed);
    if (packed.images.empty()) return;
    packed.material_images = std::move(of_material);
    if (has_normals) packed.normal_maps = std::move(normal_maps);
}

}  // namespace pl
