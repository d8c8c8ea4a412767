// Scenes with textures, holes, light from far away and a lens, made so that their light is known or that they need every effect.
#pragma once

#include "tests/support/scenes/closed_scenes.h"

namespace pl::test {

/// Gives every triangle coordinates of its own, some far out.
inline void scatter_uvs(SceneDescription& scene, Uniforms& random) {
    for (TriangleDescription& triangle : scene.triangles) {
        const auto first = static_cast<std::uint32_t>(scene.uvs.size());
        for (int corner = 0; corner < 3; ++corner)
            scene.uvs.emplace_back(random.between(-2, 3), random.between(-2, 3));
        triangle.uv = {first, first + 1, first + 2};
    }
}

/// Every point of every surface reflects an image's value and emits the rest: radiance is 1 everywhere.
inline SceneDescription painted_equilibrium(SceneDescription scene) {
    Uniforms random(11);
    scatter_uvs(scene, random);
    TextureDescription reflects{.width = 8, .height = 8};
    TextureDescription emits{.width = 8, .height = 8, .repeats = true};
    for (int i = 0; i < 64; ++i) {
        // Sixty-fourths, so that half floats hold both, and their sum, exactly.
        const auto part = [&] { return static_cast<float>(6 + random.below(40)) / 64.0f; };
        const glm::vec4 texel{part(), part(), part(), 1.0f};
        reflects.texels.push_back(texel);
        emits.texels.push_back({1.0f - texel.x, 1.0f - texel.y, 1.0f - texel.z, 1.0f});
    }
    scene.textures = {reflects, emits};
    for (MaterialDescription& material : scene.materials) {
        material.albedo = material.emission = glm::vec3(1.0f);
        material.two_sided_emission = true;
        material.textures = {.albedo = 0, .emission = 1};
    }
    return scene;
}

/// Adds sheets with random holes across the scene's x and z axes.
inline SceneDescription with_lattices(SceneDescription scene, glm::vec3 low, glm::vec3 high) {
    Uniforms random(12);
    const glm::vec3 c = 0.5f * (low + high);
    const auto first = scene.triangles.size();
    for (const float share : {0.2f, 0.25f, 0.7f}) {
        const float x = glm::mix(low.x, high.x, share);
        const float z = glm::mix(low.z, high.z, share);
        add_triangle(scene, Vec3f{x, low.y, low.z}, Vec3f{x, high.y, high.z}, Vec3f{x, low.y, high.z});
        add_triangle(scene, Vec3f{low.x, low.y, z}, Vec3f{high.x, low.y, z}, Vec3f{c.x, high.y, z});
    }
    TextureDescription opacity{.content = TextureContent::Opacity, .width = 16, .height = 16};
    for (int i = 0; i < 256; ++i) opacity.texels.emplace_back(1.0f, 1.0f, 1.0f, random.below(3) == 0 ? 1.0f : 0.0f);
    scene.textures.push_back(opacity);
    MaterialDescription lattice = scene.materials[scene.triangles[0].material];
    lattice.name = "lattice";
    lattice.textures.opacity = static_cast<std::uint32_t>(scene.textures.size() - 1);
    scene.materials.push_back(lattice);
    for (std::size_t i = first; i < scene.triangles.size(); ++i) {
        scene.triangles[i].material = static_cast<std::uint32_t>(scene.materials.size() - 1);
        const auto uv = static_cast<std::uint32_t>(scene.uvs.size());
        for (int corner = 0; corner < 3; ++corner) scene.uvs.emplace_back(random.next(), random.next());
        scene.triangles[i].uv = {uv, uv + 1, uv + 2};
    }
    return scene;
}

/// A sky of radiance a + b y.
inline EnvironmentMapDescription linear_sky(float a, float b) {
    EnvironmentMapDescription map{.width = 64, .height = 128};
    for (int row = 0; row < 128; ++row) {
        const double cosine = std::cos(3.14159265358979323846 * (row + 0.5) / 128);
        map.texels.insert(map.texels.end(), 64, glm::vec3(a + b * static_cast<float>(cosine)));
    }
    return map;
}

/// A plane that is seen from above, so large that no path sees its edge, and nothing else.
inline SceneDescription plane_scene(float albedo) {
    SceneDescription scene;
    scene.name = "plane";
    scene.materials.push_back(gray(albedo));
    constexpr float s = 1e4f;
    add_triangle(scene, Vec3f{-s, 0, s}, Vec3f{s, 0, s}, Vec3f{0, 0, -s});
    scene.camera = {.eye = {0, 1, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}};
    return scene;
}

/// A closed box of many surfaces that needs every effect: lobes, anisotropy, blends, images, holes, a window to map, sun and sky, a lens.
inline SceneDescription every_effect() {
    BoxLook look;
    look.albedo.fill(glm::vec3(0.7f, 0.6f, 0.5f));
    look.emission[kCeiling] = glm::vec3(2.0f);
    SceneDescription scene = box_scene(look);
    scene.name = "every effect";
    scene.triangles.erase(scene.triangles.begin() + 2 * kWallX1);  // half of a wall is a window
    Uniforms random(13);
    scatter_uvs(scene, random);
    TextureDescription image{.width = 5, .height = 3};
    for (int i = 0; i < 15; ++i) image.texels.emplace_back(random.next(), random.next(), random.next(), 1.0f);
    scene.textures = {image};
    scene.materials[kFloor].textures = {.albedo = 0, .normal = 0};
    scene.materials[kCeiling].textures = {.emission = 0};
    scene.materials[kWallX0].kind = SurfaceKind::Plastic;
    scene.materials[kWallX0].roughness = 0.4f;
    scene.materials[kWallX0].textures = {.albedo = 0, .roughness = 0};
    scene.materials[kWallZ1].kind = SurfaceKind::Conductor;
    scene.materials[kWallZ1].specular = glm::vec3(0.9f, 0.8f, 0.7f);
    scene.materials[kWallZ1].blend = {.other = kWallX0, .share = 0.8f};
    scene.materials[kWallZ1].textures.blend = 0;
    scene.materials[kWallX0].blend = {.other = kFloor, .share = 0.5f};
    scene.materials[kWallZ0].kind = SurfaceKind::Conductor;
    scene.materials[kWallZ0].roughness = 0.5f;
    scene.materials[kWallZ0].anisotropy = 0.7f;
    scene.materials[kWallZ0].specular = glm::vec3(0.6f, 0.7f, 0.8f);
    scene = with_lattices(std::move(scene), glm::vec3(0.0f), glm::vec3(1.0f));
    scene.materials.push_back(scene.materials.back());
    scene.materials.back().opacity = 0.6f;
    scene.materials.back().opacity_rule = OpacityRule::Blend;
    scene.triangles.back().material = static_cast<std::uint32_t>(scene.materials.size() - 1);
    scene.normals = {Vec3f{0.1f, 1.0f, 0.05f}, Vec3f{-0.1f, 0.9f, 0.2f}};
    scene.triangles[2 * kFloor].normal = {0, 1, 0};
    for (std::size_t i = 0; i < scene.positions.size(); ++i)
        scene.vertex_colors.emplace_back(random.between(0.5f, 1.0f), random.between(0.5f, 1.0f), 1.0f);
    scene.environment = glm::vec3(0.1f, 0.2f, 0.3f);
    scene.environment_map = linear_sky(1.0f, 0.5f);
    scene.environment_map.rotation_deg = 40.0f;
    scene.sun = {.direction = {2, 1, 0.5f}, .radiance = glm::vec3(500.0f), .angle_deg = 3.0f};
    scene.camera.aperture_radius = 0.02f;
    scene.camera.focus_distance = 0.4f;
    return scene;
}

}  // namespace pl::test
