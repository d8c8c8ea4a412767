#include "core/io/mitsuba/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/io/line_reader.h"
#include "core/io/mtl_surface.h"
#include "core/io/texture_file.h"

namespace pl {
namespace {

/// Names of indices of refraction.
constexpr std::array<std::pair<std::string_view, float>, 9> kIndices = {{{"vacuum", 1.0f},
                                                                         {"air", 1.000277f},
                                                                         {"water", 1.333f},
                                                                         {"ice", 1.31f},
                                                                         {"bk7", 1.5046f},
                                                                         {"polypropylene", 1.49f},
                                                                         {"acrylic glass", 1.49f},
                                                                         {"amber", 1.55f},
                                                                         {"diamond", 2.419f}}};

/// Reflectances at normal incidence of metals by name.
constexpr std::array<std::pair<std::string_view, glm::vec3>, 6> kMetals = {{{"none", {1.0f, 1.0f, 1.0f}},
                                                                            {"Ag", {0.972f, 0.960f, 0.915f}},
                                                                            {"Al", {0.913f, 0.922f, 0.924f}},
                                                                            {"Au", {1.0f, 0.766f, 0.336f}},
                                                                            {"Cu", {0.955f, 0.638f, 0.538f}},
                                                                            {"Cr", {0.550f, 0.556f, 0.554f}}}};

/// Share of diffuse light that a smooth interface reflects from inside. [d'Eon and Irving 2011]
double internal_reflectance(double eta) { return -1.4399 / (eta * eta) + 0.7099 / eta + 0.6681 + 0.0636 * eta; }

class MitsubaSurface {
public:
    MitsubaSurface(const MitsubaFile& file, const MitsubaObject& bsdf, SceneDescription& scene)
        : file_(file), bsdf_(bsdf), scene_(scene) {}

    MaterialDescription run() {
        const std::string type = mitsuba_name(bsdf_.type());
        const bool is_rough = type.starts_with("rough");
        if (type == "diffuse") {
            color("reflectance", material_.albedo, 0.5f);
        } else if (type == "conductor" || type == "roughconductor") {
            read_conductor();
        } else if (type == "dielectric" || type == "roughdielectric" || type == "thindielectric") {
            read_dielectric(type == "thindielectric");
        } else if (type == "plastic" || type == "roughplastic") {
            read_plastic();
        } else if (type == "principled" || type == "principledthin") {
            read_principled();
        } else {
            bsdf_.note(fmt::format("surfaces of the type {} are shown as gray", in_quotes(type)));
            material_.albedo = glm::vec3(0.5f);
        }
        if (is_rough) read_roughness();
        return material_;
    }

private:
    static glm::vec3 within_one(const glm::vec3& color) { return glm::min(color, glm::vec3(1.0f)); }

    /// A color or a texture, which then multiplies 1.
    void color(const std::string& name, glm::vec3& to, float standard) {
        const MitsubaObject texture = mitsuba_target(file_, bsdf_.property(name));
        if (texture.element() == "texture") {
            to = read_texture_of(texture);
            return;
        }
        to = within_one(bsdf_.color(name).value_or(glm::vec3(standard)));
    }

    glm::vec3 read_texture_of(const MitsubaObject& texture) {
        const std::string type = texture.type();
        if (type != "bitmap") {
            texture.note(fmt::format("textures of the type {} are shown as one color", in_quotes(type)));
            const glm::vec3 first = texture.color("color0").value_or(glm::vec3(0.4f));
            return within_one(0.5f * (first + texture.color("color1").value_or(glm::vec3(0.2f))));
        }
        if (texture.property("to_uv") || texture.property("uscale") || texture.property("vscale"))
            texture.note("transformations of images are left out");
        const std::string wrap = texture.text("wrap_mode").value_or("repeat");
        material_.textures.albedo =
            add_texture(scene_, texture.file("filename"), TextureContent::Color, wrap != "clamp");
        return glm::vec3(1.0f);
    }

    float index(const char* name, float standard) {
        const MitsubaObject property = bsdf_.property(name);
        if (property.element() != "string") return bsdf_.number(name).value_or(standard);
        const std::string value = property.attribute("value");
        for (const auto& [known, number] : kIndices)
            if (known == value) return number;
        property.note(
            fmt::format("the material {} is not known: index of refraction {}", in_quotes(value), standard));
        return standard;
    }

    /// Of the inside over the outside, within the valid range.
    float read_ior(float standard) {
        const float outside = index("ext_ior", 1.000277f);
        const float ior = index("int_ior", standard) / (outside > 0.0f ? outside : 1.0f);
        if (!(ior >= kLeastIor && ior <= kMostIor)) {
            bsdf_.note(
                fmt::format("an index of refraction outside of [{}, {}] is moved into it", kLeastIor, kMostIor));
        }
        return ior >= kLeastIor ? std::min(ior, kMostIor) : kLeastIor;
    }

    /// Reflectance at normal incidence by eta and k. [Born and Wolf, section 14.2]
    void read_conductor() {
        material_.kind = SurfaceKind::Conductor;
        glm::vec3 reflectance(1.0f);
        if (const auto eta = bsdf_.color("eta")) {
            const glm::vec3 n = *eta / std::max(bsdf_.number("ext_eta").value_or(1.0f), 1e-3f);
            const glm::vec3 k = bsdf_.color("k").value_or(glm::vec3(0.0f));
            reflectance = ((n - 1.0f) * (n - 1.0f) + k * k) / ((n + 1.0f) * (n + 1.0f) + k * k);
        } else {
            reflectance = metal(bsdf_.text("material").value_or("Cu"));
        }
        glm::vec3 tint(1.0f);
        color("specular_reflectance", tint, 1.0f);
        material_.specular = within_one(reflectance * tint);
        bsdf_.note("metals rise to white at grazing angles by Schlick's approximation");
    }

    glm::vec3 metal(const std::string& name) {
        for (const auto& [known, reflectance] : kMetals)
            if (known == name) return reflectance;
        bsdf_.note(fmt::format("the metal {} is not known: shown as chrome", in_quotes(name)));
        return kMetals.back().second;
    }

    void read_dielectric(bool is_thin) {
        material_.kind = SurfaceKind::Dielectric;
        material_.ior = is_thin ? 1.0f : read_ior(1.5046f);
        material_.specular = within_one(bsdf_.color("specular_reflectance").value_or(glm::vec3(1.0f)));
        material_.transmission = within_one(bsdf_.color("specular_transmittance").value_or(glm::vec3(1.0f)));
        if (is_thin) bsdf_.note("thin panes are shown as clear ones without reflection");
    }

    void read_plastic() {
        material_.kind = SurfaceKind::Plastic;
        material_.ior = read_ior(1.49f);
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
        if (bsdf_.number("metallic").value_or(0.0f) >= 0.5f) {
            material_.kind = SurfaceKind::Conductor;
            material_.specular = base;
        } else if (bsdf_.number("spec_trans").value_or(0.0f) >= 0.5f) {
            material_.kind = SurfaceKind::Dielectric;
            material_.transmission = base;
            material_.textures.albedo = kNoTexture;
        } else {
            material_.kind = SurfaceKind::Plastic;
            material_.albedo = base;
        }
        bsdf_.note("principled surfaces are shown as the nearest of metal, glass and plastic");
    }

    void read_roughness() {
        float alpha = bsdf_.number("alpha").value_or(0.1f);
        if (const auto along = bsdf_.number("alpha_u")) {
            alpha = std::sqrt(std::max(*along * bsdf_.number("alpha_v").value_or(*along), 0.0f));
            bsdf_.note("anisotropic facets are shown as isotropic ones");
        }
        if (bsdf_.text("distribution").value_or("beckmann") != "ggx")
            bsdf_.note("facets of another distribution are shown as those of GGX");
        const float roughness = std::sqrt(std::clamp(alpha, 0.0f, 1.0f));
        const bool is_smooth = roughness < kLeastRoughness ||
                               (material_.kind == SurfaceKind::Dielectric && material_.ior < kLeastRoughIor);
        material_.roughness = is_smooth ? 0.0f : roughness;
    }

    const MitsubaFile& file_;
    const MitsubaObject& bsdf_;
    SceneDescription& scene_;
    MaterialDescription material_;
};

bool is_adapter(const std::string& type) {
    constexpr std::array<std::string_view, 7> kAdapters = {"twosided", "mask",      "bumpmap",     "normalmap",
                                                           "coating",  "blendbsdf", "roughcoating"};
    return std::find(kAdapters.begin(), kAdapters.end(), type) != kAdapters.end();
}

}  // namespace

MitsubaObject mitsuba_target(const MitsubaFile& file, const MitsubaObject& object) {
    if (object.element() != "ref") return object;
    const MitsubaObject target = file.by_id(object.attribute("id"));
    if (!target)
        object.fail(fmt::format("'ref': expected the id of an object, got {}", in_quotes(object.attribute("id"))));
    return target;
}

MaterialDescription mitsuba_surface(const MitsubaFile& file, const MitsubaObject& bsdf, SceneDescription& scene) {
    MitsubaObject inner = bsdf;
    for (int depth = 0; is_adapter(mitsuba_name(inner.type())); ++depth) {
        if (inner.type() != "twosided") {
            inner.note(fmt::format("the effect of {} is left out: the surface inside of it is shown",
                                   in_quotes(inner.type())));
        }
        MitsubaObject next;
        for (const MitsubaObject& child : inner.children()) {
            const MitsubaObject target = mitsuba_target(file, child);
            if (!next && target.element() == "bsdf") next = target;
        }
        if (!next || depth > 16) {
            inner.fail(
                fmt::format("{}: expected a surface inside, got {}", inner.type(), next ? "a circle" : "none"));
        }
        inner = next;
    }
    return MitsubaSurface(file, inner, scene).run();
}

}  // namespace pl
