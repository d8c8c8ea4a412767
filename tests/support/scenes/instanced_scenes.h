// A room with instances of many materials.
#pragma once

#include "tests/support/scenes/image_scenes.h"
#include "tests/support/scenes/instanced_meshes.h"
#include "tests/support/scenes/shipped_scenes.h"

namespace pl::test {

/// Materials of all kinds that may be on a mesh.
inline std::vector<MaterialDescription> materials_of_meshes() {
    return {{.name = "clay", .albedo = {0.7f, 0.4f, 0.3f}},
            {.name = "satin", .kind = SurfaceKind::Conductor, .roughness = 0.5f, .specular = {0.9f, 0.8f, 0.6f}},
            {.name = "wine", .kind = SurfaceKind::Dielectric, .absorption = {0.001f, 0.004f, 0.004f}},
            {.name = "gauze", .albedo = glm::vec3{0.8f}, .opacity = 0.4f, .opacity_rule = OpacityRule::Blend},
            {.name = "lacquer", .albedo = {0.1f, 0.2f, 0.6f}, .kind = SurfaceKind::Plastic},
            {.name = "painted", .albedo = glm::vec3{0.9f}, .textures = {.albedo = 0, .normal = 1}}};
}

/// The Cornell box with instances of a spiky ball and of a box of each of these materials, whose corners have colors.
inline SceneDescription room_of_instances(const std::vector<MaterialDescription>& materials) {
    SceneDescription scene = shipped_scene("cornell");
    scene.name = "instances";
    const auto first = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.insert(scene.materials.end(), materials.begin(), materials.end());
    const auto count = static_cast<std::uint32_t>(materials.size());
    for (std::uint32_t i = 0; i < 2 * count; ++i) {
        const std::size_t triangles = scene.triangles.size();
        if (i < count)
            add_spiky_sphere(scene, 5, 7, 30.0f, 60.0f, i, first + i);
        else
            add_box(scene, Vec3f{-40.0f}, Vec3f{40.0f}, false, first + i - count);
        make_mesh(scene, triangles);
    }
    Uniforms random(31);
    for (int i = 0; i < 20; ++i)
        scene.instances.push_back({random.below(2 * count), any_placement(random, random.cube(80.0f, 470.0f), 1.0f)});
    while (scene.vertex_colors.size() < scene.positions.size())
        scene.vertex_colors.push_back(random.cube(0.5f, 1.0f));
    scatter_uvs(scene, random);
    for (const TextureContent content : {TextureContent::Color, TextureContent::Normal}) {
        TextureDescription image{.content = content, .width = 4, .height = 4};
        for (int i = 0; i < 16; ++i) image.texels.emplace_back(random.cube(0.3f, 1.0f), 1.0f);
        scene.textures.push_back(image);
    }
    return scene;
}

}  // namespace pl::test
