#include "core/io/gltf/surface_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/io/gltf/material_values.h"
#include "core/io/mtl.h"
#include "core/kernel/shading/absorption.h"
#include "core/kernel/shading/velvet.h"
#include "core/scene/anisotropy.h"
#include "core/scene/surface_info.h"

namespace pl {
namespace {

/// Extensions and members that change the picture and are not supported, with the words for them.
constexpr std::array<std::pair<const char*, const char*>, 12> kLeftOut = {{
    {"/occlusionTexture", "occlusion images are left out: the light itself is traced"},
    {"/extensions/KHR_materials_sheen/sheenColorTexture", "images of the color of sheen are left out"},
    {"/extensions/KHR_materials_sheen/sheenRoughnessTexture", "images of the roughness of sheen are left out"},
    {"/extensions/KHR_materials_iridescence", "iridescence is left out"},
    {"/extensions/KHR_materials_anisotropy/anisotropyTexture", "images of anisotropy are left out"},
    {"/extensions/KHR_materials_dispersion", "dispersion is left out"},
    {"/extensions/KHR_materials_diffuse_transmission", "diffuse transmission is left out"},
    {"/extensions/KHR_materials_subsurface", "subsurface scattering is left out"},
    {"/extensions/KHR_materials_transmission/transmissionTexture", "images of transmission are left out"},
    {"/extensions/KHR_materials_specular/specularTexture", "images of the specular amount are left out"},
    {"/extensions/KHR_materials_specular/specularColorTexture", "images of the specular color are left out"},
    {"/extensions/KHR_materials_clearcoat/clearcoatNormalTexture", "normal maps of a clear coat are left out"},
}};

/// Absorption per length by the share of light that is left behind a distance.
float absorption_of(float left, float distance) {
    const float depth = left > 0.0f ? -std::log(left) : kOpaqueDepth;
    return std::min(std::min(depth, kOpaqueDepth) / distance, std::numeric_limits<float>::max());
}

float strongest(const glm::vec3& color) { return std::max(color.x, std::max(color.y, color.z)); }

/// Reads one material of the file.
class GltfSurfaceReader {
public:
    GltfSurfaceReader(GltfFile& file, SceneDescription& scene, GltfImages& images, std::uint32_t number)
        : file_(file), json_(file.json()), scene_(scene), images_(images), at_(fmt::format("/materials/{}", number)),
          pbr_(at_ + "/pbrMetallicRoughness") {}

    GltfSurface run(std::string name) {
        if (json_.has(specular_gloss()))
            read_specular_gloss();
        else
            read_metal_rough();
        roughness_ = material_.roughness;
        roughness_image_ = material_.textures.roughness;
        read_anisotropy();
        read_specular();
        read_transmission();
        read_sheen();
        read_clearcoat();
        read_unlit();
        read_emission();
        read_alpha();
        read_normals();
        note_left_out();
        add(std::move(name));
        return surface_;
    }

private:
    std::string extension(const char* name) const { return fmt::format("{}/extensions/KHR_materials_{}", at_, name); }
    std::string specular_gloss() const { return extension("pbrSpecularGlossiness"); }

    void note(const std::string& kind) { file_.note(kind, at_); }

    float number(const std::string& pointer, float standard, float least, float most) {
        return clamped_number(file_, pointer, standard, least, most);
    }
    float share(const std::string& pointer, float standard) { return number(pointer, standard, 0.0f, 1.0f); }

    /// Notes the texture coordinates of an image; a surface has one choice of them.
    const std::string& placed(const std::string& info) {
        if (!json_.has(info)) return info;
        const UvMapping mapping = read_uv_mapping(file_, info);
        if (has_uv_ && !(mapping == surface_.uv))
            note("images of a material with several texture coordinates: those of the first image serve all");
        surface_.uv = has_uv_ ? surface_.uv : mapping;
        has_uv_ = true;
        return info;
    }

    /// Base color with its opacity.
    void read_base(const std::string& pointer) {
        const glm::vec4 factor = clamped_shares(file_, pointer, 4);
        base_ = glm::vec3(factor);
        alpha_ = factor.w;
    }

    void read_metal_rough() {
        base_at_ = pbr_ + "/baseColorTexture";
        read_base(pbr_ + "/baseColorFactor");
        material_.roughness = share(pbr_ + "/roughnessFactor", 1.0f);
        placed(base_at_);
        const std::string image = placed(pbr_ + "/metallicRoughnessTexture");
        material_.textures.roughness = images_.roughness(image);
        metal_factor_ = share(pbr_ + "/metallicFactor", 1.0f);
        metalness_ = metalness_of(scene_, material_.textures.roughness, metal_factor_);
        material_.ior = number(extension("ior") + "/ior", 1.5f, 0.0f, kMostIor);
        if (material_.ior < kLeastIor)
            material_.ior = material_.ior == 0.0f ? kMostIor : kLeastIor;  // 0: reflects everything
    }

    void read_specular_gloss() {
        const std::string at = specular_gloss();
        base_at_ = placed(at + "/diffuseTexture");
        read_base(at + "/diffuseFactor");
        const glm::vec3 specular = glm::vec3(clamped_shares(file_, at + "/specularFactor", 3));
        const float gloss = share(at + "/glossinessFactor", 1.0f);
        const std::string image = placed(at + "/specularGlossinessTexture");
        material_.textures.roughness = images_.roughness_of_gloss(image, gloss);
        material_.roughness = material_.textures.roughness == kNoTexture ? 1.0f - gloss : 1.0f;
        const bool is_metal = !json_.has(image) && strongest(specular) > std::max(kGltfHalf, strongest(base_));
        metal_factor_ = is_metal ? 1.0f : 0.0f;
        metalness_ = metalness_of(scene_, kNoTexture, metal_factor_);
        if (is_metal) base_ = specular;
        note("specular and glossiness are shown as the nearer of metal and plastic");
    }

    /// The direction of facets, of the metal alone. [KHR_materials_anisotropy]
    void read_anisotropy() {
        const std::string at = extension("anisotropy");
        strength_ = share(at + "/anisotropyStrength", 0.0f);
        if (strength_ == 0.0f) return;
        turn_deg_ = glm::degrees(json_.number(at + "/anisotropyRotation").value_or(0.0f));
        if (metalness_.least < 1.0f) note("anisotropy of other surfaces than metals is left out");
        if (metalness_.most > 0.0f && roughness_image_ != kNoTexture)
            note("anisotropy with an image of roughness is that of its mean");
    }

    /// The amount and color of the reflection of dielectrics. [KHR_materials_specular]
    void read_specular() {
        const std::string at = extension("specular");
        const float amount = share(at + "/specularFactor", 1.0f);
        const glm::vec3 tint = color_or(json_, at + "/specularColorFactor", glm::vec3(1.0f));
        material_.specular = glm::clamp(amount * tint, glm::vec3(0.0f), glm::vec3(1.0f));
        material_.kind = strongest(material_.specular) > 0.0f ? SurfaceKind::Plastic : SurfaceKind::Diffuse;
    }

    void read_transmission() {
        const std::string at = extension("transmission");
        if (share(at + "/transmissionFactor", 0.0f) < kGltfHalf) {
            if (json_.has(at)) note("transmission below one half is left out");
            return;
        }
        if (metalness_.mean >= kGltfHalf) {  // metals let nothing through
            if (metalness_.least < 1.0f) note_glass();
            metalness_ = {1.0f, 1.0f, 1.0f};
            return;
        }
        material_.kind = SurfaceKind::Dielectric;
        material_.transmission = base_;
        if (material_.ior < kLeastRoughIor) {
            material_.roughness = 0.0f;
            material_.textures.roughness = kNoTexture;
        }
        read_volume();
    }

    /// The inside of glass: it absorbs, or there is none. [KHR_materials_volume]
    void read_volume() {
        const std::string at = extension("volume");
        if (!(json_.number(at + "/thicknessFactor").value_or(0.0f) > 0.0f)) {
            read_thin();
            return;
        }
        const std::optional<float> distance = json_.number(at + "/attenuationDistance");
        if (!distance) return;
        if (!(*distance > 0.0f)) {
            note("glass that absorbs within no distance is shown as clear");
            return;
        }
        const glm::vec3 left = glm::vec3(clamped_shares(file_, at + "/attenuationColor", 3));
        for (int i = 0; i < 3; ++i) material_.absorption[i] = absorption_of(left[i], *distance);
    }

    void read_thin() {
        if (material_.roughness >= kLeastRoughness) {
            note("frosted thin panes are shown as solid glass");
            return;
        }
        material_.kind = SurfaceKind::Pane;
        material_.textures.roughness = kNoTexture;
    }

    /// Fibers over the base, in the place of its reflection. [KHR_materials_sheen]
    void read_sheen() {
        const std::string at = extension("sheen");
        if (!json_.has(at + "/sheenColorFactor")) return;
        const glm::vec3 color = glm::vec3(clamped_shares(file_, at + "/sheenColorFactor", 3));
        if (strongest(color) == 0.0f) return;
        const bool fits = metalness_.mean < kGltfHalf && !is_glass(material_.kind);
        if (!fits || metalness_.most > 0.0f) note("sheen on metal or glass is left out");
        if (!fits) return;
        material_.kind = SurfaceKind::Velvet;
        material_.specular = color;
        material_.roughness = share(at + "/sheenRoughnessFactor", 0.0f);
        material_.textures.roughness = kNoTexture;
        note("sheen takes the place of the reflection of its base");
        if (material_.roughness >= SheenFibers::kLeastRoughness) return;
        material_.roughness = SheenFibers::kLeastRoughness;
        note(fmt::format("sheen of a roughness below {0} is shown as one of {0}", SheenFibers::kLeastRoughness));
    }

    void read_clearcoat() {
        const std::string at = extension("clearcoat");
        const float amount = share(at + "/clearcoatFactor", 0.0f);
        if (amount == 0.0f) return;
        const bool fits = amount >= kGltfHalf && metalness_.mean < kGltfHalf && !is_glass(material_.kind);
        if (!fits || metalness_.most > 0.0f)
            note("a clear coat on metal or glass, or of less than one half, is left out");
        if (!fits) return;
        if (material_.kind == SurfaceKind::Velvet) note("sheen under a clear coat is left out");
        material_.kind = SurfaceKind::Plastic;
        material_.specular = glm::vec3(1.0f);
        material_.ior = 1.5f;
        material_.roughness = share(at + "/clearcoatRoughnessFactor", 0.0f);
        material_.textures.roughness = kNoTexture;
        note("a clear coat takes the place of the reflection of its base");
    }

    void read_unlit() {
        if (json_.has(extension("unlit"))) {
            material_.kind = SurfaceKind::Diffuse;
            metalness_ = {};
            note("unlit surfaces are shown as diffuse ones");
        }
    }

    void read_emission() {
        const float strength = json_.number(extension("emissive_strength") + "/emissiveStrength").value_or(1.0f);
        const glm::vec3 emission = color_or(json_, at_ + "/emissiveFactor", glm::vec3(0.0f));
        material_.emission = glm::max(emission, glm::vec3(0.0f)) * std::max(strength, 0.0f);
        material_.two_sided_emission = json_.boolean(at_ + "/doubleSided").value_or(false);
        if (material_.emission != glm::vec3(0.0f))
            material_.textures.emission = images_.color(placed(at_ + "/emissiveTexture"));
    }

    void read_alpha() {
        const std::string mode = json_.text(at_ + "/alphaMode").value_or("OPAQUE");
        if (mode != "OPAQUE" && mode != "MASK" && mode != "BLEND")
            file_.fail(at_ + "/alphaMode", fmt::format("expected OPAQUE, MASK or BLEND, got '{}'", mode));
        if (mode == "MASK")
            read_mask();
        else
            material_.textures.albedo = images_.color(base_at_);
        if (mode != "BLEND") return;
        material_.opacity = alpha_;
        material_.opacity_rule = OpacityRule::Blend;
        material_.textures.opacity = material_.textures.albedo;
        surface_.is_hidden = alpha_ == 0.0f;
        surface_.vertex_alpha = VertexAlpha::Scales;
    }

    void read_mask() {
        const std::string cutoff_at = at_ + "/alphaCutoff";
        if (json_.number(cutoff_at).value_or(kGltfHalf) > 1.0f) {
            note("surfaces with an alphaCutoff above 1 are cut away");  // [glTF 2.0, section 3.9.4]
            surface_.is_hidden = true;
            return;
        }
        const float cutoff = number(cutoff_at, kGltfHalf, 0.0f, 1.0f);
        const bool has_holes = cutoff > 0.0f && json_.has(base_at_);
        // Holes are where the texture's alpha is below one half.
        const float scale = has_holes ? alpha_ * kGltfHalf / cutoff : 1.0f;
        material_.textures.albedo = images_.color(base_at_, scale);
        if (has_holes) {
            material_.textures.opacity = material_.textures.albedo;
            surface_.vertex_alpha = scale > 1.0f ? VertexAlpha::LeftOut : VertexAlpha::Scales;
            return;
        }
        surface_.is_hidden = alpha_ < cutoff;
        surface_.vertex_alpha = VertexAlpha::Cut;
        surface_.least_alpha = cutoff > 0.0f ? cutoff / alpha_ : 0.0f;
    }

    void read_normals() {
        const std::string at = at_ + "/normalTexture";
        if (!json_.has(at)) return;
        material_.textures.normal = images_.normals(placed(at));
        material_.normal_strength = number(at + "/scale", 1.0f, 0.0f, kMostNormalStrength);
    }

    void note_left_out() {
        for (const auto& [pointer, words] : kLeftOut)
            if (json_.has(at_ + pointer)) file_.note(words, at_ + pointer);
    }

    void note_glass() { note("blends with glass are shown as the component of the larger share"); }

    /// Adds the material to the scene: as a metal, as none, or as a blend of both. [glTF 2.0, appendix B.3]
    void add(std::string name) {
        material_.name = std::move(name);
        const bool is_solid_glass = has_inside(material_.kind);
        if (is_solid_glass && metalness_.most > 0.0f) note_glass();
        if (is_solid_glass || metalness_.most == 0.0f) {
            surface_.material = append(without_metal());
        } else if (metalness_.least == 1.0f) {
            surface_.material = append(as_metal());
        } else {
            surface_.material = append(without_metal());
            const std::uint32_t metal = append(part_of_blend(as_metal()));
            const bool varies = metalness_.least < metalness_.most;
            MaterialDescription& base = scene_.materials[surface_.material];
            base.blend = {.other = metal, .share = varies ? metal_factor_ : metalness_.mean};
            if (varies) base.textures.blend = images_.metalness(pbr_ + "/metallicRoughnessTexture");
        }
    }

    std::uint32_t append(MaterialDescription material) {
        if (material.roughness < kLeastRoughness) material.roughness = 0.0f;
        scene_.materials.push_back(std::move(material));
        return static_cast<std::uint32_t>(scene_.materials.size() - 1);
    }

    /// A blend takes reflection alone from the other material.
    static MaterialDescription part_of_blend(MaterialDescription material) {
        material.name += " (metal)";
        material.emission = glm::vec3(0.0f);
        material.opacity = 1.0f;
        material.opacity_rule = OpacityRule::Threshold;
        material.textures.emission = material.textures.opacity = material.textures.normal = kNoTexture;
        return material;
    }

    MaterialDescription without_metal() const {
        MaterialDescription material = material_;
        if (is_glass(material_.kind))
            material.textures.albedo = kNoTexture;
        else
            material.albedo = base_;
        if (material.kind == SurfaceKind::Diffuse) {
            material.roughness = 0.0f;
            material.textures.roughness = kNoTexture;
        }
        return material;
    }

    MaterialDescription as_metal() {
        MaterialDescription material = material_;
        material.kind = SurfaceKind::Conductor;
        material.specular = base_;
        material.roughness = roughness_;
        material.textures.roughness = roughness_image_;
        if (strength_ == 0.0f) return material;
        if (!stretch_facets(scene_, strength_, material)) note(kWidestFacets);
        if (surface_.uv.rotation != 0.0f) note("images that are turned turn the direction of anisotropy, too");
        material.rotation_deg += turn_deg_;
        surface_.is_anisotropic = true;
        return material;
    }

    GltfFile& file_;
    const JsonDocument& json_;
    SceneDescription& scene_;
    GltfImages& images_;
    std::string at_, pbr_;
    std::string base_at_;  ///< textureInfo of the base color
    MaterialDescription material_;
    GltfSurface surface_;
    Metalness metalness_;
    float metal_factor_ = 1.0f;
    float roughness_ = 1.0f;                      ///< of the metal; glass and coats may have another one
    std::uint32_t roughness_image_ = kNoTexture;  ///< of the roughness of the metal
    float strength_ = 0.0f;                       ///< of the anisotropy of the metal
    float turn_deg_ = 0.0f;                       ///< of its direction
    glm::vec3 base_{1.0f};
    float alpha_ = 1.0f;
    bool has_uv_ = false;
};

}  // namespace

GltfSurface read_surface(GltfFile& file, SceneDescription& scene, GltfImages& images, std::uint32_t number,
                         const std::string& name) {
    return GltfSurfaceReader(file, scene, images, number).run(name);
}

}  // namespace pl
