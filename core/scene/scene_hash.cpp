#include "core/scene/scene_hash.h"

#include <algorithm>
#include <bit>
#include <string_view>

#include <fmt/format.h>

#include "core/base/hash.h"

namespace pl {
namespace {

void add(Fnv1a& hash, const glm::vec3& v) {
    hash.add(v.x);
    hash.add(v.y);
    hash.add(v.z);
}

void add(Fnv1a& hash, const glm::uvec3& v) {
    hash.add(std::uint64_t{v.x});
    hash.add(std::uint64_t{v.y});
    hash.add(std::uint64_t{v.z});
}

/// Adds the optional parts of a scene (lobes, anisotropies, colors of vertices, opacities, blends, textures, far lights, lights without
/// extent), each preceded by its name. Absent parts add nothing, so that a new kind of part does not change the hashes of existing scenes.
class PartHasher {
public:
    explicit PartHasher(Fnv1a& hash) : hash_(hash) {}

    void add_surfaces(const std::vector<MaterialDescription>& materials) {
        for (std::size_t i = 0; i < materials.size(); ++i) {
            const MaterialDescription& m = materials[i];
            if (m.kind == SurfaceKind::Diffuse) continue;
            begin("surface", i);
            hash_.add(std::uint64_t{static_cast<std::uint32_t>(m.kind)});
            hash_.add(m.roughness);
            hash_.add(m.ior);
            add(hash_, m.specular);
            add(hash_, m.transmission);
            if (m.absorbs()) {
                begin("absorption", i);
                add(hash_, m.absorption);
            }
            if (m.is_anisotropic()) {
                begin("anisotropy", i);
                hash_.add(m.anisotropy);
                hash_.add(m.rotation_deg);
            }
            if (m.edge_tint == glm::vec3(1.0f)) continue;
            begin("edge tint", i);
            add(hash_, m.edge_tint);
        }
    }

    void add_vertex_colors(const std::vector<glm::vec3>& colors) {
        if (colors.empty()) return;
        begin("vertex colors", colors.size());
        for (const glm::vec3& color : colors) add(hash_, color);
    }

    void add_opacities(const std::vector<MaterialDescription>& materials) {
        for (std::size_t i = 0; i < materials.size(); ++i) {
            const MaterialDescription& m = materials[i];
            if (!m.may_have_holes() || (m.opacity == 1.0f && m.opacity_rule == OpacityRule::Threshold)) continue;
            begin("opacity", i);
            hash_.add(m.opacity);
            hash_.add(std::uint64_t{static_cast<std::uint32_t>(m.opacity_rule)});
        }
    }

    void add_blends(const std::vector<MaterialDescription>& materials) {
        for (std::size_t i = 0; i < materials.size(); ++i) {
            const MaterialDescription& m = materials[i];
            if (!m.blend.is_any()) continue;
            begin("blend", i);
            hash_.add(std::uint64_t{m.blend.other});
            hash_.add(m.blend.share);
            hash_.add(std::uint64_t{m.textures.blend});
        }
    }

    void add_textures(const SceneDescription& scene) {
        bool any = false;
        for (std::size_t i = 0; i < scene.materials.size(); ++i) {
            const TextureUse& use = scene.materials[i].textures;
            if (!use.any()) continue;
            any = true;
            begin("textures of material", i);
            for (const std::uint32_t index : {use.albedo, use.roughness, use.emission, use.opacity})
                hash_.add(std::uint64_t{index});
            if (use.normal == kNoTexture) continue;
            begin("normal map", use.normal);
            hash_.add(scene.materials[i].normal_strength);
            hash_.add(std::uint64_t{static_cast<std::uint32_t>(scene.materials[i].normal_green)});
        }
        if (any)
            for (std::size_t i = 0; i < scene.textures.size(); ++i) add_texture(scene.textures[i], i);
        if (!any && std::ranges::none_of(scene.materials, &MaterialDescription::is_anisotropic)) return;
        begin("image coordinates", scene.uvs.size());
        for (const glm::vec2& uv : scene.uvs) add_pair(uv.x, uv.y);
        for (const TriangleDescription& triangle : scene.triangles) add(hash_, triangle.uv);
    }

    void add_far_lights(const SceneDescription& scene) {
        const EnvironmentMapDescription& map = scene.environment_map;
        if (!map.texels.empty()) {
            begin("environment map", map.width);
            hash_.add(map.rotation_deg);
            if (map.axes != glm::mat3(1.0f))
                for (int i = 0; i < 3; ++i) add(hash_, map.axes[i]);
            for (const glm::vec3& texel : map.texels) add(hash_, texel);
        }
        if (scene.sun.radiance != glm::vec3(0.0f)) {
            begin("sun", 0);
            add(hash_, scene.sun.direction);
            add(hash_, scene.sun.radiance);
            hash_.add(scene.sun.angle_deg);
        }
    }

    void add_punctual_lights(const std::vector<PunctualLightDescription>& lights) {
        for (std::size_t i = 0; i < lights.size(); ++i) {
            const PunctualLightDescription& light = lights[i];
            begin("punctual light", i);
            hash_.add(std::uint64_t{static_cast<std::uint32_t>(light.kind)});
            for (const glm::vec3& vector : {light.position, light.direction, light.intensity}) add(hash_, vector);
            hash_.add(light.inner_deg);
            hash_.add(light.outer_deg);
            hash_.add(std::uint64_t{static_cast<std::uint32_t>(light.falloff)});
        }
    }

    void add_instances(const SceneDescription& scene) {
        if (scene.meshes.empty()) return;
        for (const MeshDescription& mesh : scene.meshes) hash_.add(std::uint64_t{mesh.triangle_count});
        hash_.add(std::uint64_t{scene.instances.size()});
        for (const InstanceDescription& instance : scene.instances) {
            hash_.add(std::uint64_t{instance.mesh});
            for (int column = 0; column < 4; ++column) add(hash_, instance.to_world[column]);
        }
    }

private:
    void begin(std::string_view part, std::size_t number) {
        hash_.add(part);
        hash_.add(std::uint64_t{number});
    }
    void add_texture(const TextureDescription& texture, std::size_t number) {
        begin("texture", number);
        hash_.add(std::uint64_t{texture.width});
        hash_.add(std::uint64_t{texture.repeats});
        for (const glm::vec4& texel : texture.texels) {
            add_pair(texel.x, texel.y);
            add_pair(texel.z, texel.w);
        }
    }
    /// Two floats as one 64-bit value: images are large.
    void add_pair(float a, float b) {
        const std::uint64_t high = std::bit_cast<std::uint32_t>(a == 0.0f ? 0.0f : a);
        hash_.add(high << 32 | std::bit_cast<std::uint32_t>(b == 0.0f ? 0.0f : b));
    }

    Fnv1a& hash_;
};

}  // namespace

std::string scene_hash(const SceneDescription& scene) {
    Fnv1a hash;
    hash.add(std::uint64_t{scene.positions.size()});
    for (const glm::vec3& position : scene.positions) add(hash, position);
    hash.add(std::uint64_t{scene.normals.size()});
    for (const glm::vec3& normal : scene.normals) add(hash, normal);
    hash.add(std::uint64_t{scene.triangles.size()});
    for (const TriangleDescription& triangle : scene.triangles) {
        add(hash, triangle.vertex);
        add(hash, triangle.normal);
        hash.add(std::uint64_t{triangle.material});
    }
    hash.add(std::uint64_t{scene.materials.size()});
    for (const MaterialDescription& material : scene.materials) {
        add(hash, material.albedo);
        add(hash, material.emission);
        hash.add(std::uint64_t{material.two_sided_emission});
    }
    add(hash, scene.environment);
    PartHasher parts(hash);
    parts.add_surfaces(scene.materials);
    parts.add_vertex_colors(scene.vertex_colors);
    parts.add_opacities(scene.materials);
    parts.add_blends(scene.materials);
    parts.add_textures(scene);
    parts.add_far_lights(scene);
    parts.add_punctual_lights(scene.punctual_lights);
    parts.add_instances(scene);
    return fmt::format("{:016x}", hash.value());
}

}  // namespace pl
