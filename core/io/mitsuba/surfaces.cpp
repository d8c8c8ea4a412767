#include "core/io/mitsuba/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/io/line_reader.h"
#include "core/io/mitsuba/blends.h"
#include "core/io/mitsuba/coats.h"
#include "core/io/mtl.h"
#include "core/kernel/shading/fresnel.h"

namespace pl {
namespace {

/// Complex indices of refraction of metals in red, green and blue. [Johnson and Christy 1972, 1974; Rakic 1995]
struct MetalIndex {
    std::string_view name;
    glm::vec3 eta, k;
};
constexpr std::array<MetalIndex, 5> kMetals = {{{"Ag", {0.155f, 0.117f, 0.138f}, {4.83f, 3.12f, 2.15f}},
                                                {"Al", {1.66f, 0.880f, 0.521f}, {9.22f, 6.27f, 4.84f}},
                                                {"Au", {0.143f, 0.375f, 1.44f}, {3.98f, 2.39f, 1.60f}},
                                                {"Cu", {0.200f, 0.924f, 1.10f}, {3.91f, 2.45f, 2.14f}},
                                                {"Cr", {3.10f, 3.20f, 2.33f}, {3.30f, 3.33f, 3.14f}}}};

struct Metal {
    glm::vec3 specular{1.0f}, edge_tint{1.0f};
};

/// Reflectance at normal incidence and edge tint by the complex index of refraction.
Metal metal_of(const glm::vec3& eta, const glm::vec3& k) {
    Metal metal;
    for (int i = 0; i < 3; ++i) {
        metal.specular[i] = fresnel_complex(1.0f, eta[i], k[i]);
        metal.edge_tint[i] = edge_tint_of(metal.specular[i], fresnel_complex(kEdgeCosine, eta[i], k[i]));
    }
    return metal;
}

class SurfaceReader {
public:
    SurfaceReader(const MitsubaObject& bsdf, SceneDescription& scene) : bsdf_(bsdf), scene_(scene) {}

    MitsubaSurface run() {
        const std::string type = mitsuba_name(bsdf_.type());
        const bool is_rough = type.starts_with("rough") && type != "roughdiffuse";
        if (type == "diffuse" || type == "roughdiffuse") {
            color("reflectance", material_.albedo, 0.5f);
            if (type == "roughdiffuse") bsdf_.note("rough diffuse surfaces are shown as smooth ones");
        } else if (type == "null") {
            material_.albedo = glm::vec3(0.0f);
            material_.opacity = 0.0f;
            material_.opacity_rule = OpacityRule::Blend;
        } else if (type == "conductor" || type == "roughconductor") {
            read_conductor();
        } else if (type == "dielectric" || type == "roughdielectric" || type == "thindielectric") {
            read_dielectric(type == "thindielectric" ? SurfaceKind::Pane : SurfaceKind::Dielectric);
        } else if (type == "plastic" || type == "roughplastic") {
            read_plastic();
        } else if (type == "principled" || type == "principledthin") {
            read_principled();
        } else {
            bsdf_.leave_out(fmt::format("surfaces of the type {} are shown as gray", in_quotes(type)));
            material_.albedo = glm::vec3(0.5f);
        }
        if (is_rough) read_mitsuba_facets(bsdf_, material_);
        return {.material = material_,
                .others = std::move(others_),
                .image = image_,
                .shows_vertex_colors = shows_vertex_colors_,
                .is_inside_out = is_inside_out_};
    }

private:
    static glm::vec3 within_one(const glm::vec3& color) { return glm::min(color, glm::vec3(1.0f)); }

    /// A color or a texture, which then multiplies 1.
    void color(const std::string& name, glm::vec3& to, float standard) {
        const MitsubaObject texture = bsdf_.property(name);
        if (texture.element() == "texture") {
            to = read_texture_of(texture);
            return;
        }
        to = within_one(bsdf_.color(name).value_or(glm::vec3(standard)));
    }

    glm::vec3 read_texture_of(const MitsubaObject& texture) {
        if (const auto image = mitsuba_image(texture, TextureContent::Color, scene_)) {
            material_.textures.albedo = *image;
            image_ = texture;
            return glm::vec3(1.0f);
        }
        if (texture.type() == "mesh_attribute" && texture.text("name") == "vertex_color") {
            shows_vertex_colors_ = true;
            return within_one(glm::vec3(texture.number("scale").value_or(1.0f)));
        }
        texture.leave_out(fmt::format("textures of the type {} are shown as one color", in_quotes(texture.type())));
        const glm::vec3 first = texture.color("color0").value_or(glm::vec3(0.4f));
        return within_one(0.5f * (first + texture.color("color1").value_or(glm::vec3(0.2f))));
    }

    void read_conductor() {
        material_.kind = SurfaceKind::Conductor;
        const Metal metal = read_metal();
        glm::vec3 tint(1.0f);
        color("specular_reflectance", tint, 1.0f);
        material_.specular = within_one(metal.specular * tint);
        material_.edge_tint = metal.edge_tint;
    }

    Metal read_metal() {
        if (const auto eta = bsdf_.color("eta")) {
            const float outside = std::max(bsdf_.number("ext_eta").value_or(1.0f), 1e-3f);
            return metal_of(*eta / outside, bsdf_.color("k").value_or(glm::vec3(0.0f)) / outside);
        }
        const std::string name = bsdf_.text("material").value_or("Cu");
        if (name == "none") return {};
        const auto known = std::ranges::find(kMetals, name, &MetalIndex::name);
        if (known != kMetals.end()) return metal_of(known->eta, known->k);
        bsdf_.note(fmt::format("the metal {} is not known: shown as chrome", in_quotes(name)));
        return metal_of(kMetals.back().eta, kMetals.back().k);
    }

    void read_dielectric(SurfaceKind kind) {
        material_.kind = kind;
        // Glass that is less dense than what is around it is the other side of one that is denser.
        const float ior = index_ratio(bsdf_, 1.5046f);
        is_inside_out_ = kind == SurfaceKind::Dielectric && ior < 1.0f;
        material_.ior = usable_ior(bsdf_, is_inside_out_ ? 1.0f / ior : ior);
        material_.specular = within_one(bsdf_.color("specular_reflectance").value_or(glm::vec3(1.0f)));
        material_.transmission = within_one(bsdf_.color("specular_transmittance").value_or(glm::vec3(1.0f)));
    }

    void read_plastic() {
        material_.kind = SurfaceKind::Plastic;
        material_.ior = usable_ior(bsdf_, index_ratio(bsdf_, 1.49f));
        material_.specular = within_one(bsdf_.color("specular_reflectance").value_or(glm::vec3(1.0f)));
        color("diffuse_reflectance", material_.albedo, 0.5f);
        if (bsdf_.boolean("nonlinear").value_or(false)) {
            // The base is seen through the coat again and again, and darkens each time.
            const auto inside = static_cast<float>(internal_reflectance(static_cast<double>(material_.ior)));
            material_.albedo = material_.albedo * (1.0f - inside) / (1.0f - inside * material_.albedo);
        }
    }

    void read_principled() {
        glm::vec3 base(0.5f);
        color("base_color", base, 0.5f);
        const float roughness = std::clamp(bsdf_.number("roughness").value_or(0.5f), 0.0f, 1.0f);
        material_.roughness = roughness < kLeastRoughness ? 0.0f : roughness;
        MaterialDescription metal = material_;
        metal.kind = SurfaceKind::Conductor;
        metal.specular = base;
        // [Burley 2012, "Physically-Based Shading at Disney", 5.4]
        metal.anisotropy = 0.9f * std::clamp(bsdf_.number("anisotropic").value_or(0.0f), 0.0f, 1.0f);
        if (bsdf_.number("spec_trans").value_or(0.0f) >= 0.5f) {
            material_.kind = SurfaceKind::Dielectric;
            material_.transmission = base;
            material_.textures.albedo = kNoTexture;
        } else {
            material_.kind = SurfaceKind::Plastic;
            material_.albedo = base;
            read_sheen();
        }
        const MitsubaWeight metallic = mitsuba_weight(bsdf_, "metallic", 0.0f, scene_);
        others_ = blended_parts(bsdf_, {material_}, {metal}, metallic, scene_);
        material_ = others_.front();
        others_.erase(others_.begin());
        if (!image_) image_ = metallic.texture;
        bsdf_.note("principled surfaces are shown as metal, plastic, a blend of the two, or glass");
    }

    /// The sheen of a principled surface, (1 - cos)^5 of the angle between light and facets, has a sixth of the directional albedo of
    /// velvet of this roughness, to 0.01 from 5 degrees above the surface on.
    void read_sheen() {
        constexpr float kRoughness = 0.3f;
        constexpr float kShare = 1.0f / 6.0f;
        const float sheen = std::clamp(bsdf_.number("sheen").value_or(0.0f), 0.0f, 1.0f);
        const float tinted = std::clamp(bsdf_.number("sheen_tint").value_or(0.0f), 0.0f, 1.0f);
        if (sheen == 0.0f) return;
        if (bsdf_.number("specular").value_or(0.5f) > 0.0f) {
            bsdf_.note("the sheen of principled surfaces whose specular is not 0 is left out");
            return;
        }
        const float brightness = luminance(material_.albedo);
        const glm::vec3 tint = brightness > 0.0f ? material_.albedo / brightness : glm::vec3(1.0f);
        material_.kind = SurfaceKind::Velvet;
        material_.specular = within_one(kShare * sheen * glm::mix(glm::vec3(1.0f), tint, tinted));
        material_.roughness = kRoughness;
        bsdf_.note("the sheen of principled surfaces is shown as the nearest velvet");
    }

    const MitsubaObject& bsdf_;
    SceneDescription& scene_;
    MaterialDescription material_;
    std::vector<MaterialDescription> others_;
    MitsubaObject image_;
    bool shows_vertex_colors_ = false;
    bool is_inside_out_ = false;
};

}  // namespace

void share_mitsuba_uv(const MitsubaObject& image, MitsubaSurface& surface) {
    if (surface.image && image && mitsuba_to_uv(surface.image) != mitsuba_to_uv(image))
        image.note("images of one surface with transformations of their own share that of its color");
    if (!surface.image) surface.image = image;
}

MitsubaSurface mitsuba_surface(const MitsubaObject& bsdf, SceneDescription& scene, int depth) {
    const MitsubaAdapters adapters = read_mitsuba_adapters(bsdf, scene);
    MitsubaSurface surface = mitsuba_name(adapters.inside.type()) == "blendbsdf"
                                 ? mitsuba_blend(adapters.inside, scene, depth)
                                 : SurfaceReader(adapters.inside, scene).run();
    if (adapters.coat) add_mitsuba_coat(adapters.coat, surface);
    MaterialDescription& material = surface.material;
    if (adapters.normals != kNoTexture) {
        material.textures.normal = adapters.normals;
        material.normal_green = NormalGreen::Left;
    }
    if (adapters.has_mask) {
        material.opacity = adapters.opacity;
        material.opacity_rule = OpacityRule::Blend;
        material.textures.opacity = adapters.opacities;
    }
    if (adapters.relief) surface.relief = adapters.relief;
    share_mitsuba_uv(adapters.image, surface);
    return surface;
}

}  // namespace pl
