// The unit cube with diffuse walls: radiance at the middle of each wall, solved by collocation with exact
// point-to-patch form factors (6 x 64 x 64 patches, Richardson extrapolation) and confirmed by a random walk.
// The radiosity of six patches is no reference: it is several per cent off.
#pragma once

#include "tests/support/scenes/closed_scenes.h"

namespace pl::test {

/// Three independent scenes at once, one per color channel: the channels share nothing but the random numbers.
struct CubeReference {
    BoxLook look;
    bool small_light = false;  ///< only the square [0.25, 0.75]^2 of the ceiling emits
    /// Leaving radiance, emission included, at the middle of each wall.
    std::array<glm::dvec3, kWalls> center{};
    double error = 0.0;  ///< bound on the error of the numbers above
};

namespace cube_detail {

inline BoxLook look_of(glm::vec3 x0, glm::vec3 x1, glm::vec3 others) {
    BoxLook look;
    look.albedo = {x0, x1, others, others, others, others};
    look.emission[kCeiling] = glm::vec3(1.0f);
    return look;
}

}  // namespace cube_detail

/// The whole ceiling emits 1. Albedos: red 0.5; green 0.8; blue 0.63 at x0, 0.14 at x1, 0.75 elsewhere.
inline CubeReference cube_with_bright_ceiling() {
    return {.look = cube_detail::look_of({0.5f, 0.8f, 0.63f}, {0.5f, 0.8f, 0.14f}, {0.5f, 0.8f, 0.75f}),
            .center = {glm::dvec3{0.17765, 0.68366, 0.27882},
                       {0.17765, 0.68366, 0.06884},
                       {0.19760, 0.71308, 0.36203},
                       {1.09181, 1.55226, 1.20903},
                       {0.17765, 0.68366, 0.33309},
                       {0.17765, 0.68366, 0.33309}},
            .error = 1.0e-5};
}

/// A quarter of the ceiling emits 1. Albedos: red 0.5; green 0.63 at x0, 0.14 at x1, 0.75 elsewhere; blue as green
/// with x0 and x1 exchanged.
inline CubeReference cube_with_lamp() {
    return {.look = cube_detail::look_of({0.5f, 0.63f, 0.14f}, {0.5f, 0.14f, 0.63f}, {0.5f, 0.75f, 0.75f}),
            .small_light = true,
            .center = {glm::dvec3{0.05780, 0.08725, 0.02114},
                       {0.05780, 0.02114, 0.08725},
                       {0.05737, 0.10272, 0.10272},
                       {1.02512, 1.05650, 1.05650},
                       {0.05780, 0.10379, 0.10379},
                       {0.05780, 0.10379, 0.10379}},
            .error = 2.0e-5};
}

/// The scene of a reference, without T-junctions: four trapezoids around the lamp.
inline SceneDescription cube_scene(const CubeReference& reference) {
    if (!reference.small_light) return box_scene(reference.look);
    BoxLook look = reference.look;
    look.emission[kCeiling] = glm::vec3(0.0f);
    SceneDescription scene = box_scene(look);
    std::erase_if(scene.triangles, [](const TriangleDescription& t) { return t.material == kCeiling; });
    scene.materials.push_back(
        {.name = "lamp", .albedo = look.albedo[kCeiling], .emission = reference.look.emission[kCeiling]});
    // The box numbers its corners by their bits x, y, z: these four are the ceiling, counter-clockwise from inside.
    constexpr std::array<std::uint32_t, 4> kOuter{3, 7, 6, 2};
    std::array<std::uint32_t, 4> inner{};
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::vec3 corner = scene.positions[kOuter[i]];
        inner[i] = add_vertex(scene, {0.25f + 0.5f * corner.x, 1.0f, 0.25f + 0.5f * corner.z});
    }
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t next = (i + 1) % 4;
        add_quad(scene, kOuter[i], kOuter[next], inner[next], inner[i], kCeiling);
    }
    add_quad(scene, inner[0], inner[1], inner[2], inner[3], kWalls);
    return scene;
}

}  // namespace pl::test
