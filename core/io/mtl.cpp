#include "core/io/mtl.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/line_reader.h"
#include "core/io/mtl_reader.h"
#include "core/io/obj_names.h"
#include "core/io/tally.h"
#include "core/io/texture_file.h"
#include "core/scene/surface_info.h"

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

namespace fs = std::filesystem;

namespace {

/// Whether a texel is not gray, beyond the rounding of lossy images.
bool has_colors(const TextureDescription& texture) {
    constexpr float kRounding = 0.02f;
    return std::any_of(texture.texels.begin(), texture.texels.end(), [](const glm::vec4& texel) {
        return std::abs(texel.x - texel.y) > kRounding || std::abs(texel.x - texel.z) > kRounding;
    });
}

fs::path folder_of_scene(const SceneDescription& scene, const fs::path& mtl) {
    return scene.source.empty() ? mtl.parent_path() : scene.source.parent_path();
}

class TextureAdder {
public:
    TextureAdder(SceneDescription& scene, const fs::path& mtl)
        : scene_(scene), mtl_(mtl), root_(folder_of_scene(scene, mtl)) {
        const fs::path relative = mtl.parent_path().lexically_relative(root_);
        from_ = relative == "." ? fs::path() : relative;
    }

    std::uint32_t add(const MtlMap& map, TextureContent content) {
        if (!map) return kNoTexture;
        const NamedFile file = find_named_file(root_, from_, map.name, true);
        if (!file.is_there && file.is_elsewhere) {
            return add_texture_by(scene_, file.path, content, !map.clamps, [&]() -> TextureDescription {
                throw Error(ErrorKind::Input,
                            fmt::format("{}: {} is outside of the scene's folder, where none of its "
                                        "name is",
                                        place(mtl_, map.line), in_quotes(map.name)));
            });
        }
        if (file.is_elsewhere && moved_names_.insert(map.name).second) {
            moved_.add(map.line,
                       [&] { return fmt::format("image {}: {}", in_quotes(map.name), file.path.string()); });
        }
        return add_texture(scene_, file.path, content, !map.clamps);
    }

    /// Exporters write images of normals as `map_Bump`, too; an image without colors is one of heights.
    std::uint32_t add_normals(const MtlEntry& entry) {
        const std::size_t before = scene_.textures.size();
        const std::uint32_t texture = add(entry.norm ? entry.norm : entry.bump, TextureContent::Normal);
        if (entry.norm || texture == kNoTexture || has_colors(scene_.textures[texture])) return texture;
        scene_.textures.resize(before);
        return add_relief(entry.bump);
    }

    void tell() const { moved_.tell(scene_.warnings, mtl_, "read, because the named one is not there"); }

private:
    std::uint32_t add_relief(const MtlMap& map) {
        // The format has no unit for heights: relative to the image a relief does not depend on its resolution, nor on the model's size.
        constexpr float kRise = 0.01f;
        const std::size_t before = scene_.textures.size();
        const std::uint32_t texture = add(map, TextureContent::Height);
        if (texture >= before && texture != kNoTexture) {
            TextureDescription& heights = scene_.textures[texture];
            turn_into_normals(heights, glm::vec2(kRise * static_cast<float>(heights.width)));
        }
        return texture;
    }

    SceneDescription& scene_;
    const fs::path& mtl_;
    fs::path root_;
    fs::path from_;  ///< folder of the file, from `root_`
    std::set<std::string> moved_names_;
    Tally moved_;
};

/// The place of the images of a material: the place of the first image. `differs` if another image has another place.
UvScale uvs_of(const MtlEntry& entry, bool& differs) {
    const MtlMap* first = nullptr;
    for (const MtlMap* map : {&entry.map_kd, &entry.map_ke, entry.map_pr ? &entry.map_pr : &entry.map_ns,
                              &entry.map_d, entry.norm ? &entry.norm : &entry.bump}) {
        if (!*map) continue;
        first = first == nullptr ? map : first;
        differs = differs || !(map->uvs == first->uvs);
    }
    return first == nullptr ? UvScale{} : first->uvs;
}

/// Gray of 0.8, or of 0.64, its square: written beside images by exporters that do not mean it.
bool is_default_of_exporters(const std::optional<glm::vec3>& kd) {
    const auto is_gray_of = [&](float value) {
        return glm::all(glm::lessThan(glm::abs(*kd - glm::vec3(value)), glm::vec3(1e-4f)));
    };
    return kd && (is_gray_of(0.8f) || is_gray_of(0.64f));
}

}  // namespace

std::vector<UvScale> load_mtl(const fs::path& path, SceneDescription& scene, MapKd map_kd) {
    TextureAdder textures(scene, path);
    Tally dimmed;
    Tally differing;
    std::vector<UvScale> uvs;
    for (MtlEntry& entry : read_mtl(read_text_file(path), path, scene.warnings)) {
        std::vector<std::string> notes;
        if (entry.map_kd && map_kd == MapKd::Replaces) {
            entry.kd.reset();
        } else if (entry.map_kd && is_default_of_exporters(entry.kd)) {
            dimmed.add(entry.line);
        }
        MaterialDescription material = surface_of(entry, notes);
        if (entry.map_kd && entry.kd == glm::vec3(0.0f)) {
            notes.emplace_back("multiplies its map_Kd with a black Kd");
        }
        const bool is_smooth = material.kind == SurfaceKind::Diffuse || material.roughness == 0.0f;
        material.textures = {
            .albedo = textures.add(entry.map_kd, TextureContent::Color),
            .roughness = is_smooth ? kNoTexture
                                   : textures.add(entry.map_pr ? entry.map_pr : entry.map_ns, TextureContent::Number),
            .emission = textures.add(entry.map_ke, TextureContent::Color),
            .opacity = textures.add(entry.map_d, TextureContent::Opacity)};
        material.textures.normal = textures.add_normals(entry);
        material.normal_strength = entry.norm ? entry.norm.strength : entry.bump.strength;
        for (const std::string& note : notes) {
            scene.warnings.push_back(
                fmt::format("{}: material {} {}", place(path, entry.line), in_quotes(entry.name), note));
        }
        scene.materials.push_back(std::move(material));
        bool differs = false;
        uvs.push_back(uvs_of(entry, differs));
        if (differs) differing.add(entry.line);
    }
    textures.tell();
    differing.tell(scene.warnings, path, "images of one material with different -s or -o: those of the first count");
    dimmed.tell(scene.warnings, path,
                "the image of map_Kd is multiplied by a Kd that is a default of exporters (\"map_kd\": \"replace\" "
                "in a scene "
                "file: the image alone, as Blender shows it)");
    return uvs;
}

}  // namespace pl
