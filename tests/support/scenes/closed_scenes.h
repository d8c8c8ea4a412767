// Closed scenes whose answer is known, as descriptions: boxes seen from inside, and any scene put into equilibrium.
#pragma once

#include <array>
#include <string>

#include "tests/support/scenes/shapes.h"

namespace pl::test {

/// Walls of a box in the order of its materials: two per axis, the one with the smaller coordinate first.
enum Wall { kWallX0, kWallX1, kFloor, kCeiling, kWallZ0, kWallZ1, kWalls };

struct BoxLook {
    std::array<glm::vec3, kWalls> albedo{};
    std::array<glm::vec3, kWalls> emission{};
};

/// A closed box, one material per wall, the camera in its middle.
inline SceneDescription box_scene(const BoxLook& look, glm::vec3 low = glm::vec3(0.0f),
                                  glm::vec3 high = glm::vec3(1.0f)) {
    SceneDescription scene;
    scene.name = "box";
    add_box(scene, low, high, true);
    for (std::uint32_t wall = 0; wall < kWalls; ++wall) {
        scene.materials.push_back(
            {.name = "wall" + std::to_string(wall), .albedo = look.albedo[wall], .emission = look.emission[wall]});
        scene.triangles[2 * wall].material = scene.triangles[2 * wall + 1].material = wall;
    }
    scene.camera.eye = 0.5f * (low + high);
    scene.camera.target = scene.camera.eye + glm::vec3(0.0f, 0.0f, -1.0f);
    return scene;
}

/// A box in which everything emits e and reflects rho: radiance e/(1-rho) at every point in every direction.
inline SceneDescription furnace_scene(float emission, float albedo) {
    BoxLook look;
    look.albedo.fill(glm::vec3(albedo));
    look.emission.fill(glm::vec3(emission));
    return box_scene(look, {-1.0f, -0.75f, -1.5f}, {1.0f, 0.75f, 1.5f});
}

/// The same surfaces with four triangles for each one.
inline SceneDescription with_quartered_triangles(SceneDescription scene) {
    const std::vector<TriangleDescription> triangles = std::move(scene.triangles);
    scene.triangles.clear();
    for (const TriangleDescription& triangle : triangles) {
        const glm::vec3 a = scene.positions[triangle.vertex[0]];
        const glm::vec3 b = scene.positions[triangle.vertex[1]];
        const glm::vec3 c = scene.positions[triangle.vertex[2]];
        const glm::vec3 ab = 0.5f * (a + b), bc = 0.5f * (b + c), ca = 0.5f * (c + a);
        add_triangle(scene, a, ab, ca, triangle.material);
        add_triangle(scene, ab, b, bc, triangle.material);
        add_triangle(scene, ca, bc, c, triangle.material);
        add_triangle(scene, ab, bc, ca, triangle.material);
    }
    return scene;
}

/// The same geometry and albedos with emission 1 - albedo on both sides of everything: in a closed scene the
/// radiance is then 1 at every point in every direction and channel, whatever the albedos are.
inline SceneDescription in_equilibrium(SceneDescription scene) {
    for (MaterialDescription& material : scene.materials) {
        material.emission = glm::vec3(1.0f) - material.albedo;
        material.two_sided_emission = true;
    }
    return scene;
}

inline glm::vec3 wall_center(Wall wall, glm::vec3 low, glm::vec3 high) {
    glm::vec3 center = 0.5f * (low + high);
    center[wall / 2] = wall % 2 == 0 ? low[wall / 2] : high[wall / 2];
    return center;
}

/// A view of the middle of a box's wall, so narrow that every pixel sees that point.
inline CameraDescription camera_at_center(Wall wall, glm::vec3 low, glm::vec3 high) {
    const bool horizontal = wall == kFloor || wall == kCeiling;
    return {.eye = 0.5f * (low + high),
            .target = wall_center(wall, low, high),
            .up = horizontal ? glm::vec3(0.0f, 0.0f, 1.0f) : glm::vec3(0.0f, 1.0f, 0.0f),
            .fov_deg = 0.5f};
}

}  // namespace pl::test
