#include "core/io/mitsuba/coats.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/io/line_reader.h"
#include "core/io/mtl.h"
#include "core/kernel/shading/fresnel.h"
#include "core/scene/anisotropy.h"

namespace pl {
namespace {

/// Names of indices of refraction.
constexpr std::array<std::pair<std::string_view, float>, 24> kIndices = {{{"vacuum", 1.0f},
                                                                          {"helium", 1.000036f},
                                                                          {"hydrogen", 1.000132f},
                                                                          {"air", 1.000277f},
                                                                          {"carbon dioxide", 1.00045f},
                                                                          {"water", 1.333f},
                                                                          {"acetone", 1.36f},
                                                                          {"ethanol", 1.361f},
                                                                          {"carbon tetrachloride", 1.461f},
                                                                          {"glycerol", 1.4729f},
                                                                          {"benzene", 1.501f},
                                                                          {"silicone oil", 1.52045f},
                                                                          {"bromine", 1.661f},
                                                                          {"water ice", 1.31f},
                                                                          {"ice", 1.31f},
                                                                          {"fused quartz", 1.458f},
                                                                          {"pyrex", 1.47f},
                                                                          {"acrylic glass", 1.49f},
                                                                          {"polypropylene", 1.49f},
                                                                          {"bk7", 1.5046f},
                                                                          {"sodium chloride", 1.544f},
                                                                          {"amber", 1.55f},
                                                                          {"pet", 1.575f},
                                                                          {"diamond", 2.419f}}};

float index_of(const MitsubaObject& bsdf, const char* name, float standard) {
    const MitsubaObject property = bsdf.property(name);
    if (property.element() != "string") return bsdf.number(name).value_or(standard);
    const std::string value = property.attribute("value");
    for (const auto& [known, number] : kIndices)
        if (known == value) return number;
    property.note(fmt::format("the material {} is not known: index of refraction {}", in_quotes(value), standard));
    return standard;
}

/// The width of the facets, or the geometric mean of both; conductors get the anisotropy, too.
float read_width(const MitsubaObject& bsdf, MaterialDescription& material) {
    const auto along_u = bsdf.number("alpha_u");
    if (!along_u) return bsdf.number("alpha").value_or(0.1f);
    const float along_v = bsdf.number("alpha_v").value_or(*along_u);
    const float mean = std::sqrt(std::max(*along_u * along_v, 0.0f));
    if (*along_u == along_v) return mean;
    if (material.kind != SurfaceKind::Conductor) {
        bsdf.note("anisotropic facets of glass and coats are shown as isotropic ones");
        return mean;
    }
    if (!set_widths(material, std::max(*along_u, 0.0f), std::max(along_v, 0.0f))) bsdf.note(kWidestFacets);
    return material.roughness * material.roughness;
}

}  // namespace

float index_ratio(const MitsubaObject& bsdf, float standard) {
    const float outside = index_of(bsdf, "ext_ior", 1.000277f);
    return index_of(bsdf, "int_ior", standard) / (outside > 0.0f ? outside : 1.0f);
}

float usable_ior(const MitsubaObject& bsdf, float ior) {
    if (!(ior >= kLeastIor && ior <= kMostIor)) {
        bsdf.note(fmt::format("an index of refraction outside of [{}, {}] is moved into it", kLeastIor, kMostIor));
    }
    return ior >= kLeastIor ? std::min(ior, kMostIor) : kLeastIor;
}

void read_mitsuba_facets(const MitsubaObject& bsdf, MaterialDescription& material) {
    const float alpha = read_width(bsdf, material);
    if (bsdf.text("distribution").value_or("beckmann") != "ggx")
        bsdf.note("facets of another distribution are shown as those of GGX");
    const float roughness = std::sqrt(std::clamp(alpha, 0.0f, 1.0f));
    const bool is_smooth =
        roughness < kLeastRoughness || (material.kind == SurfaceKind::Dielectric && material.ior < kLeastRoughIor);
    material.roughness = is_smooth ? 0.0f : roughness;
}

double internal_reflectance(double eta) { return -1.4399 / (eta * eta) + 0.7099 / eta + 0.6681 + 0.0636 * eta; }

float edge_tint_of(float normal, float edge) {
    const float schlick = fresnel_conductor(kEdgeCosine, glm::vec3(normal), glm::vec3(0.0f)).x;
    return std::min(edge / schlick, 1.0f);
}

namespace {

/// The coat on a black base.
MaterialDescription read_coat(const MitsubaObject& coat) {
    MaterialDescription black;
    black.kind = SurfaceKind::Plastic;
    black.ior = usable_ior(coat, index_ratio(coat, 1.5046f));
    black.specular = glm::min(coat.color("specular_reflectance").value_or(glm::vec3(1.0f)), glm::vec3(1.0f));
    if (mitsuba_name(coat.type()) == "roughcoating") read_mitsuba_facets(coat, black);
    return black;
}

bool can_carry(const MaterialDescription& coat, const MaterialDescription& base) {
    if (base.kind == SurfaceKind::Diffuse) return true;
    // An image, or colors of vertices, would multiply the light of the coat, too.
    return base.kind == SurfaceKind::Conductor && base.roughness == 0.0f && coat.roughness == 0.0f &&
           base.textures.albedo == kNoTexture && base.textures.roughness == kNoTexture;
}

/// Reflectance of coat and mirror together: light that the coat reflects from inside is lost. [Mitsuba 0.6, coating]
glm::vec3 coated_reflectance(float cosine, const MaterialDescription& coat, const MaterialDescription& mirror) {
    const float outside = fresnel_dielectric(cosine, coat.ior);
    const float cosine_inside = std::sqrt(1.0f - (1.0f - cosine * cosine) / (coat.ior * coat.ior));
    const glm::vec3 inside =
        fresnel_conductor(cosine_inside, mirror.specular, edge_loss_of(mirror.specular, mirror.edge_tint));
    return outside * coat.specular + (1.0f - outside) * (1.0f - outside) * inside;
}

void put_on(const MaterialDescription& coat, MaterialDescription& base) {
    if (base.kind == SurfaceKind::Conductor) {
        const glm::vec3 normal = coated_reflectance(1.0f, coat, base);
        const glm::vec3 edge = coated_reflectance(kEdgeCosine, coat, base);
        base.specular = glm::min(normal, glm::vec3(1.0f));
        for (int i = 0; i < 3; ++i) base.edge_tint[i] = edge_tint_of(base.specular[i], edge[i]);
        return;
    }
    base.kind = SurfaceKind::Plastic;
    base.ior = coat.ior;
    base.specular = coat.specular;
    base.roughness = coat.roughness;
    // Plastic gives back the light that its coat reflects from inside, which this coat loses.
    base.albedo *= static_cast<float>(1.0 - internal_reflectance(static_cast<double>(coat.ior)));
}

}  // namespace

void add_mitsuba_coat(const MitsubaObject& coat, MitsubaSurface& surface) {
    const MaterialDescription read = read_coat(coat);
    const auto carries = [&](const MaterialDescription& base) {
        return can_carry(read, base) && !(base.kind == SurfaceKind::Conductor && surface.shows_vertex_colors);
    };
    if (!carries(surface.material) || !std::ranges::all_of(surface.others, carries)) {
        coat.note(fmt::format("the effect of {} on other surfaces than diffuse ones, and smooth metals under a "
                              "smooth coat, is left out",
                              in_quotes(coat.type())));
        return;
    }
    const MitsubaObject absorption = coat.property("sigma_a");
    if (absorption && (absorption.element() == "texture" || absorption.element() == "ref" ||
                       coat.color("sigma_a").value_or(glm::vec3(0.0f)) != glm::vec3(0.0f)))
        coat.note("absorption of coats is left out");
    put_on(read, surface.material);
    for (MaterialDescription& other : surface.others) put_on(read, other);
}

}  // namespace pl
