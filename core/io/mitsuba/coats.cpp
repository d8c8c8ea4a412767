#include "core/io/mitsuba/coats.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/io/line_reader.h"
#include "core/io/mitsuba/interfaces.h"
#include "core/kernel/shading/fresnel.h"

namespace pl {
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
