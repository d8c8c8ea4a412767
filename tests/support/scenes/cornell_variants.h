// The Cornell box with effects that no shipped scene has.
#pragma once

#include "tests/support/scenes/shapes.h"
#include "tests/support/scenes/shipped_scenes.h"

namespace pl::test {

/// The Cornell box with its lamp, and lights without extent: a point and a spot inside, a direction through the open front.
inline SceneDescription cornell_with_delta_lights() {
    SceneDescription scene = shipped_scene("cornell");
    scene.name = "lights without extent";
    scene.punctual_lights = {
        {.kind = PunctualKind::Point, .position = {90, 400, 300}, .intensity = {1e5f, 4e4f, 2e4f}},
        {.kind = PunctualKind::Spot,
         .position = {278, 500, 60},
         .direction = {-0.3f, -1, 0.9f},
         .intensity = {1e5f, 3e5f, 2e5f},
         .inner_deg = 10,
         .outer_deg = 35},
        {.kind = PunctualKind::Directional, .direction = {0.4f, -0.5f, 1}, .intensity = {1, 1, 3}}};
    return scene;
}

/// The Cornell box with two blocks of glass that absorb: a clear one, and a frosted one around a tile and a lamp.
inline SceneDescription cornell_with_stained_glass() {
    SceneDescription scene = shipped_scene("cornell");
    scene.name = "stained glass";
    const auto first = static_cast<std::uint32_t>(scene.materials.size());
    MaterialDescription glass{
        .name = "clear", .kind = SurfaceKind::Dielectric, .ior = 1.3f, .absorption = {0.001f, 0.004f, 0.01f}};
    scene.materials.push_back(glass);
    glass.name = "frosted";
    glass.roughness = 0.5f;
    scene.materials.push_back(glass);
    scene.materials.push_back({.name = "tile", .albedo = glm::vec3(0.7f)});
    scene.materials.push_back({.name = "inner lamp", .emission = {20, 30, 40}, .two_sided_emission = true});
    add_box(scene, Vec3f{60, 350, 250}, Vec3f{200, 450, 400}, false, first);
    add_box(scene, Vec3f{320, 350, 150}, Vec3f{500, 480, 330}, false, first + 1);
    add_triangle(scene, Vec3f{340, 370, 170}, Vec3f{340, 390, 310}, Vec3f{480, 380, 200}, first + 2);
    add_triangle(scene, Vec3f{400, 440, 220}, Vec3f{400, 440, 260}, Vec3f{440, 440, 240}, first + 3);
    return scene;
}

/// The Cornell box with a block of thin panes, and one that parts the room before the lamp.
inline SceneDescription cornell_with_panes() {
    SceneDescription scene = shipped_scene("cornell");
    scene.name = "thin panes";
    const auto first = static_cast<std::uint32_t>(scene.materials.size());
    MaterialDescription pane{
        .name = "pane", .kind = SurfaceKind::Pane, .ior = 2.0f, .transmission = {0.9f, 0.7f, 0.5f}};
    scene.materials.push_back(pane);
    pane.name = "weak pane";
    pane.ior = 1.3f;
    scene.materials.push_back(pane);
    add_box(scene, Vec3f{60, 350, 250}, Vec3f{200, 450, 400}, false, first);
    add_triangle(scene, Vec3f{500, 100, 100}, Vec3f{300, 540, 100}, Vec3f{400, 100, 500}, first + 1);
    return scene;
}

/// The Cornell box with blocks of blended materials: a mirror with paint, and a coat with rough metal and paint.
inline SceneDescription cornell_with_blends() {
    SceneDescription scene = shipped_scene("cornell");
    scene.name = "blends";
    const auto first = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back({.name = "mirror", .kind = SurfaceKind::Conductor, .specular = {0.9f, 0.8f, 0.6f}});
    scene.materials.back().blend = {.other = first + 1, .share = 0.4f};
    scene.materials.push_back({.name = "paint", .albedo = {0.2f, 0.5f, 0.7f}});
    scene.materials.push_back({.name = "coat", .albedo = {0.6f, 0.3f, 0.2f}, .kind = SurfaceKind::Plastic});
    scene.materials.back().blend = {.other = first + 3, .share = 0.7f};
    scene.materials.push_back({.name = "rough metal", .kind = SurfaceKind::Conductor, .roughness = 0.6f});
    scene.materials.back().blend = {.other = first + 1, .share = 0.5f};
    add_box(scene, Vec3f{60, 350, 250}, Vec3f{200, 450, 400}, false, first);
    add_box(scene, Vec3f{320, 350, 150}, Vec3f{500, 480, 330}, false, first + 2);
    return scene;
}

/// The Cornell box with blocks of anisotropic metals, one of them guided; their normals decide the directions.
inline SceneDescription cornell_with_brushed_metals() {
    SceneDescription scene = shipped_scene("cornell");
    scene.name = "brushed metals";
    const auto first = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back({.name = "satin",
                               .kind = SurfaceKind::Conductor,
                               .roughness = 0.6f,
                               .anisotropy = 0.6f,
                               .rotation_deg = 20.0f,
                               .specular = {0.9f, 0.8f, 0.6f}});
    scene.materials.push_back({.name = "brushed",
                               .kind = SurfaceKind::Conductor,
                               .roughness = 0.4f,
                               .anisotropy = 0.9f,
                               .specular = {0.7f, 0.8f, 0.9f}});
    add_box(scene, Vec3f{60, 350, 250}, Vec3f{200, 450, 400}, false, first);
    add_box(scene, Vec3f{320, 350, 150}, Vec3f{500, 480, 330}, false, first + 1);
    return scene;
}

}  // namespace pl::test
