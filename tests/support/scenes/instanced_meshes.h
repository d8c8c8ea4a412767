// Meshes in any place, turned, stretched and sheared.
#pragma once

#include "core/scene/affine.h"
#include "core/scene/instances.h"
#include "tests/support/scenes/shapes.h"

namespace pl::test {

/// Turns the triangles from `first_triangle` on into a mesh.
inline void make_mesh(SceneDescription& scene, std::size_t first_triangle) {
    scene.meshes.push_back({.name = "mesh",
                            .first_triangle = static_cast<std::uint32_t>(first_triangle),
                            .triangle_count = static_cast<std::uint32_t>(scene.triangles.size() - first_triangle)});
}

/// A transformation to `place`: any rotation, a scale of each axis up to `scale`, and in one of three cases a shear.
inline glm::mat4x3 any_placement(Uniforms& random, Vec3f place, float scale) {
    const Vec3f z = random.direction();
    const Frame frame = make_frame(z);
    const auto factor = [&] { return scale * random.between(0.3f, 1.0f); };
    glm::mat4x3 placement(factor() * frame.x, factor() * frame.y, factor() * frame.z, place);
    if (random.below(3) == 0) placement[0] += 0.5f * placement[1];
    return placement;
}

inline void add_instances(SceneDescription& scene, Uniforms& random, int count, float spread, float scale) {
    const auto meshes = static_cast<std::uint32_t>(scene.meshes.size());
    for (int i = 0; i < count; ++i)
        scene.instances.push_back(
            {random.below(meshes), any_placement(random, spread * random.cube(-1.0f, 1.0f), scale)});
}

inline SceneDescription with_copies(SceneDescription scene) {
    expand_instances(scene);
    return scene;
}

}  // namespace pl::test
