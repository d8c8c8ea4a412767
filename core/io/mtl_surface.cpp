#include "core/io/mtl_surface.h"
#include "core/scene/surface_info.h"

#include <algorithm>
#include <cmath>

namespace pl {

namespace {

/// Exponents from the largest of the format on mean a mirror.
constexpr float kMirrorExponent = 1000.0f;

/// Indices of refraction below this are ignored: programs write 1 as a default.
constexpr float kNoRefraction = 1.01f;

float strongest(const std::optional<glm::vec3>& color) {
    return color ? std::max(color->x, std::max(color->y, color->z)) : 0.0f;
}

bool has_index(const MtlEntry& entry) { return entry.ni && *entry.ni > kNoRefraction; }

bool is_metal(const MtlEntry& entry) { return entry.pm && *entry.pm >= 0.5f; }

/// Illumination models of the format; 0 and 1 are matte, 2 has a highlight.
bool is_mirror_model(int illum) { return illum == 3 || illum == 5 || illum == 8; }
bool is_glass_model(int illum) { return illum == 4 || illum == 6 || illum == 7 || illum == 9; }

SurfaceKind kind_of(const MtlEntry& entry) {
    if (entry.surface) {
        return *entry.surface;
    }
    const int illum = entry.illum.value_or(2);
    if (is_metal(entry)) {
        return SurfaceKind::Conductor;
    }
    const bool lets_through = entry.d.value_or(1.0f) < 1.0f;
    if (is_glass_model(illum) || (lets_through && may_be_glass(entry))) {
        return SurfaceKind::Dielectric;
    }
    if (is_mirror_model(illum) && strongest(entry.ks) > 0.0f) {
        // Programs write model 3 for any surface with a highlight: a mostly diffuse one is not a mirror.
        return 2.0f * strongest(entry.ks) >= strongest(entry.kd) ? SurfaceKind::Conductor : SurfaceKind::Plastic;
    }
    const bool shines = strongest(entry.ks) > 0.0f && (entry.ns || entry.pr);
    const bool is_coated = entry.pc.value_or(0.0f) > 0.0f;
    return illum >= 2 && (shines || is_coated) ? SurfaceKind::Plastic : SurfaceKind::Diffuse;
}

float roughness_of(const MtlEntry& entry, SurfaceKind kind) {
    float roughness = 0.0f;
    if (!surface_info(kind).has(material_parameter::kRoughness)) {
        return roughness;
    }
    if (entry.roughness || entry.pr) {
        roughness = entry.roughness ? *entry.roughness : *entry.pr;
    } else if (entry.map_pr || entry.map_ns) {
        roughness = 1.0f;  // multiplied by the image
    } else if (kind != SurfaceKind::Dielectric && entry.ns && *entry.ns < kMirrorExponent) {
        roughness = roughness_of_exponent(*entry.ns);
    }
    return roughness < kLeastRoughness ? 0.0f : roughness;
}

/// Programs write 1, or nothing, for the default; only transmission without refraction means 1.
float ior_of(const MtlEntry& entry, SurfaceKind kind) {
    if (entry.own_ior) {
        return *entry.own_ior;
    }
    const float usual = MaterialDescription{}.ior;
    if (is_glass(kind)) {
        return entry.ni.value_or(usual);
    }
    return has_index(entry) ? *entry.ni : usual;
}

glm::vec3 specular_of(const MtlEntry& entry, SurfaceKind kind) {
    const bool has_ks = strongest(entry.ks) > 0.0f;
    const bool has_kd = strongest(entry.kd) > 0.0f;
    if (kind == SurfaceKind::Conductor) {
        // In the metallic workflow the base color is the reflectance of the metal.
        const bool by_base = (is_metal(entry) && has_kd) || !has_ks;
        return by_base ? entry.kd.value_or(glm::vec3(1.0f)) : *entry.ks;
    }
    if (kind == SurfaceKind::Plastic && has_ks) {
        return *entry.ks / strongest(entry.ks);  // the tint only: Fresnel's equations give the reflectance
    }
    return kind == SurfaceKind::Velvet ? entry.ks.value_or(glm::vec3(1.0f)) : glm::vec3(1.0f);
}

glm::vec3 albedo_of(const MtlEntry& entry, SurfaceKind kind) {
    if (!surface_info(kind).has(material_parameter::kAlbedo)) {
        return glm::vec3(0.0f);
    }
    return entry.kd.value_or(entry.map_kd ? glm::vec3(1.0f) : glm::vec3(0.0f));
}

}  // namespace

float roughness_of_exponent(float ns) { return std::sqrt(std::sqrt(2.0f / (ns + 2.0f))); }

bool may_be_glass(const MtlEntry& entry) {
    return is_glass_model(entry.illum.value_or(2)) || entry.tf || has_index(entry);
}

MaterialDescription surface_of(const MtlEntry& entry, std::vector<std::string>& notes) {
    MaterialDescription material{.name = entry.name};
    material.kind = kind_of(entry);
    material.albedo = albedo_of(entry, material.kind);
    material.emission = entry.ke.value_or(glm::vec3(entry.map_ke ? 1.0f : 0.0f));
    material.two_sided_emission = entry.two_sided;
    const bool says_color = entry.kd || entry.ke || entry.map_kd || entry.map_ke;
    if (!says_color && surface_info(material.kind).has(material_parameter::kAlbedo)) {
        material.albedo = kDefaultAlbedo;
        notes.emplace_back("has neither Kd nor Ke and is shown in the default color");
    }
    if (!is_glass(material.kind)) {
        material.opacity = entry.d.value_or(1.0f);
    }
    if (material.opacity == 0.0f) {
        notes.emplace_back("is invisible: its opacity is 0 (d, Tr)");
    }
    if (material.opacity < 1.0f || entry.map_d) {
        material.opacity_rule = OpacityRule::Blend;
    }
    if (material.kind == SurfaceKind::Diffuse) {
        return material;
    }
    material.roughness = roughness_of(entry, material.kind);
    material.ior = ior_of(entry, material.kind);
    material.specular = specular_of(entry, material.kind);
    if (is_glass(material.kind)) {
        material.transmission = strongest(entry.tf) > 0.0f ? *entry.tf : glm::vec3(1.0f);
        if (material.roughness > 0.0f && material.ior < kLeastRoughIor) {
            material.roughness = 0.0f;
            notes.emplace_back("is rough glass of almost no refraction (Ni): shown smooth");
        }
    }
    return material;
}

}  // namespace pl
