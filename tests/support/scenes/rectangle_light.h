// A rectangular lamp over or beside a gray floor: radiance of the floor in closed form.
#pragma once

#include "core/selftest/known_scenes.h"
#include "tests/support/scenes/closed_scenes.h"

namespace pl::test {

/// A lamp of radiance 1 that only emits, and a floor y = 0 of albedo 0.6 that only reflects. Nothing else.
struct LampOverFloor {
    SceneDescription scene;
    double floor_radiance;  ///< at the point that the camera sees
};

namespace rectangle_detail {

inline constexpr float kAlbedo = 0.6f;

inline SceneDescription lamp_scene(const std::array<Vec3f, 4>& lamp, Vec3f seen) {
    SceneDescription scene;
    scene.name = "lamp";
    scene.materials = {{.name = "floor", .albedo = Vec3f{kAlbedo}}, {.name = "lamp", .emission = Vec3f{1.0f}}};
    std::uint32_t v[4];
    const auto add = [&](const std::array<Vec3f, 4>& corners, std::uint32_t material) {
        for (std::size_t i = 0; i < 4; ++i) v[i] = add_vertex(scene, corners[i]);
        add_quad(scene, v[0], v[1], v[2], v[3], material);
    };
    add({Vec3f{-10, 0, -10}, {-10, 0, 10}, {10, 0, 10}, {10, 0, -10}}, 0);
    add(lamp, 1);
    scene.camera = {.eye = seen + Vec3f{0.3f, 0.4f, 0.2f}, .target = seen, .fov_deg = 0.2f};
    return scene;
}

}  // namespace rectangle_detail

/// The lamp hangs at height 0.5 over x in [-0.4, 0.8], z in [-0.3, 0.3], and shines down.
inline LampOverFloor lamp_above(float x, float z) {
    const std::array<Vec3f, 4> lamp{Vec3f{-0.4f, 0.5f, -0.3f}, Vec3f{0.8f, 0.5f, -0.3f}, Vec3f{0.8f, 0.5f, 0.3f},
                                    Vec3f{-0.4f, 0.5f, 0.3f}};
    double factor = 0.0;
    for (const double side_x : {-0.4, 0.8})
        for (const double side_z : {-0.3, 0.3})
            factor += (side_x > 0.0 ? 1.0 : -1.0) * (side_z > 0.0 ? 1.0 : -1.0) *
                      parallel_corner_factor(side_x - static_cast<double>(x), side_z - static_cast<double>(z), 0.5);
    return {rectangle_detail::lamp_scene(lamp, {x, 0.0f, z}),
            static_cast<double>(rectangle_detail::kAlbedo) * factor};
}

/// The lamp is a strip at height 0.5, x in [-2, 2], z in [0.1, 0.5], and shines down.
inline LampOverFloor lamp_strip() {
    const std::array<Vec3f, 4> lamp{Vec3f{-2.0f, 0.5f, 0.1f}, Vec3f{2.0f, 0.5f, 0.1f}, Vec3f{2.0f, 0.5f, 0.5f},
                                    Vec3f{-2.0f, 0.5f, 0.5f}};
    const double factor = 2.0 * (parallel_corner_factor(2.0, 0.5, 0.5) - parallel_corner_factor(2.0, 0.1, 0.5));
    return {rectangle_detail::lamp_scene(lamp, Vec3f{0.0f}), static_cast<double>(rectangle_detail::kAlbedo) * factor};
}

/// The lamp stands on the floor in the plane z = 0, x in [-0.5, 0.7], 0.8 high, and shines towards +z.
inline LampOverFloor lamp_beside(float x, float z) {
    const std::array<Vec3f, 4> lamp{Vec3f{-0.5f, 0.0f, 0.0f}, Vec3f{0.7f, 0.0f, 0.0f}, Vec3f{0.7f, 0.8f, 0.0f},
                                    Vec3f{-0.5f, 0.8f, 0.0f}};
    const double distance = static_cast<double>(z);
    const double factor = perpendicular_corner_factor(0.8, 0.7 - static_cast<double>(x), distance) -
                          perpendicular_corner_factor(0.8, -0.5 - static_cast<double>(x), distance);
    return {rectangle_detail::lamp_scene(lamp, {x, 0.0f, z}),
            static_cast<double>(rectangle_detail::kAlbedo) * factor};
}

}  // namespace pl::test
