// The hard shapes as instances, near and far from the origin, large and small.
#pragma once

#include "tests/support/rays/hard_rays.h"
#include "tests/support/scenes/instanced_meshes.h"

namespace pl::test {

struct Placing {
    const char* name;
    float spread;
    float scale;
};
inline constexpr Placing kPlacings[] = {
    {"near", 1.5f, 1.0f}, {"far and large", 3000.0f, 200.0f}, {"far and small", 500.0f, 1e-2f}};

/// A floor, and instances of a shape and of a ball.
inline SceneDescription instanced_shape(const NamedShape& shape, const Placing& placing, Uniforms& random) {
    SceneDescription scene;
    scene.materials.push_back(gray());
    add_box(scene, Vec3f{-placing.spread}, Vec3f{placing.spread}, true);
    for (const bool is_ball : {false, true}) {
        const std::size_t first = scene.triangles.size();
        if (is_ball)
            add_spiky_sphere(scene, 6, 6, 0.7f, 1.0f, 5);
        else
            shape.build(scene, random);
        make_mesh(scene, first);
    }
    add_instances(scene, random, 12, placing.spread, placing.scale);
    return scene;
}

}  // namespace pl::test
