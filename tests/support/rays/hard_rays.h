// Scenes that are hard for the boxes of a hierarchy, and rays that are hard for it there.
#pragma once

#include <functional>
#include <vector>

#include "core/kernel/geometry/ray.h"
#include "core/kernel/scene/scene_view.h"
#include "tests/support/scenes/shapes.h"

namespace pl::test {

inline constexpr int kHardTriangles = 300;

/// Triangles with their first corner at `anchor` and the others `size` around it.
using Shape = std::function<void(SceneDescription&, Uniforms&)>;

inline void add_around(SceneDescription& scene, Uniforms& random, Vec3f anchor, float size) {
    const Vec3f b = anchor + size * random.cube(-1, 1);
    const Vec3f c = anchor + size * random.cube(-1, 1);
    add_triangle(scene, anchor, b, c);
}

/// A power of two between 2^-20 and 1.
inline float any_scale(Uniforms& random) { return std::exp2(-static_cast<float>(random.below(21))); }

inline void add_sliver(SceneDescription& scene, Uniforms& random, float width) {
    const Vec3f a = random.cube(-1, 1);
    const Vec3f along = random.cube(-1, 1);
    add_triangle(scene, a, a + along, a + random.next() * along + width * random.cube(-1, 1));
}

/// In a plane of constant x, at one of eight places: boxes without thickness, many of them touching.
inline void add_flat(SceneDescription& scene, Uniforms& random) {
    const float x = static_cast<float>(random.below(8)) * 0.25f;
    const auto in_plane = [&] { return Vec3f{x, random.between(-1, 1), random.between(-1, 1)}; };
    const Vec3f a = in_plane();
    const Vec3f b = in_plane();
    add_triangle(scene, a, b, in_plane());
}

inline Shape repeated(std::function<void(SceneDescription&, Uniforms&)> add) {
    return [add](SceneDescription& scene, Uniforms& random) {
        for (int i = 0; i < kHardTriangles; ++i) add(scene, random);
    };
}

struct NamedShape {
    const char* name;
    Shape build;
};

inline std::vector<NamedShape> hard_shapes() {
    return {
        {"uniform", repeated([](auto& s, auto& r) { add_around(s, r, r.cube(-1, 1), 0.2f); })},
        {"clustered",
         repeated([](auto& s, auto& r) { add_around(s, r, any_scale(r) * r.cube(-1, 1), any_scale(r)); })},
        {"slivers", repeated([](auto& s, auto& r) { add_sliver(s, r, 1e-4f); })},
        {"thin slivers", repeated([](auto& s, auto& r) { add_sliver(s, r, 1e-6f); })},
        {"flat", repeated([](auto& s, auto& r) { add_flat(s, r); })},
        {"far from the origin", repeated([](auto& s, auto& r) {
             add_around(s, r, Vec3f{1e3f, 2e3f, -500} + r.cube(-1, 1), 0.2f);
         })},
        {"one huge, many tiny",
         [](auto& s, auto& r) {
             add_triangle(s, Vec3f{-1e3f, 0, -1e3f}, Vec3f{1e3f, 0.1f, -1e3f}, Vec3f{0, 0, 1e3f});
             repeated([](auto& scene, auto& random) { add_around(scene, random, random.cube(-1, 1), 0.01f); })(s, r);
         }},
        {"closed mesh", [](auto& s, auto&) { add_spiky_sphere(s, 12, 12, 1.0f, 6.0f, 3); }},
        {"room with a block",
         [](auto& s, auto&) {
             add_box(s, Vec3f{-1}, Vec3f{1}, true);
             add_box(s, {-0.5f, -1, -0.5f}, {0.5f, 0, 0.5f}, false);
         }},
        {"room twice",
         [](auto& s, auto&) {
             add_box(s, Vec3f{-1}, Vec3f{1}, true);
             add_box(s, Vec3f{-1}, Vec3f{1}, true);
         }},
        {"everything twice",
         [](auto& s, auto&) {
             add_spiky_sphere(s, 8, 8, 1.0f, 2.0f, 4);
             add_spiky_sphere(s, 8, 8, 1.0f, 2.0f, 4);
         }},
    };
}

/// A point on a triangle, often on an edge or a corner.
inline Vec3f hard_point(const SceneView& scene, Uniforms& random) {
    const Triangle& t = scene.triangles[random.below(scene.triangles.count)];
    Vec3f b = random.cube(0.01f, 1);
    if (random.below(2) == 0) b.x = 0.0f;
    if (random.below(2) == 0) b.y = 0.0f;
    b *= 1.0f / (b.x + b.y + b.z);
    return b.x * scene.positions[t.v0] + b.y * scene.positions[t.v1] + b.z * scene.positions[t.v2];
}

/// Almost in the plane of a triangle.
inline Vec3f along_triangle(const SceneView& scene, Uniforms& random) {
    const Triangle& t = scene.triangles[random.below(scene.triangles.count)];
    const Vec3f a = scene.positions[t.v0];
    const Vec3f along =
        random.between(-1, 1) * (scene.positions[t.v1] - a) + random.between(-1, 1) * (scene.positions[t.v2] - a);
    return glm::normalize(along) + 1e-4f * random.next() * random.cube(-1, 1);
}

inline Ray hard_ray(const SceneView& scene, Uniforms& random) {
    const Vec3f on_surface = hard_point(scene, random);
    Ray ray{.origin = on_surface + random.cube(-2, 2), .direction = random.direction()};
    switch (random.below(5)) {
    case 0: ray.direction = on_surface - ray.origin; break;  // to a point, an edge or a corner
    case 1: break;
    case 2:  // along an axis, with exact zeros; from a slab plane half of the time
        ray.direction = Vec3f{0.0f};
        ray.direction[static_cast<int>(random.below(3))] = random.below(2) == 0 ? 1.0f : -1.0f;
        ray.origin = on_surface - static_cast<float>(random.below(2)) * 2.0f * ray.direction;
        break;
    case 3:  // along a triangle
        ray.direction = along_triangle(scene, random);
        ray.origin = on_surface - random.between(0, 3) * ray.direction;
        break;
    default:  // from one surface to another
        ray.origin = on_surface;
        ray.direction = hard_point(scene, random) - on_surface;
    }
    if (random.below(4) == 0) ray.t_max = random.next();
    if (random.below(4) == 0) ray.source = random.below(scene.triangles.count);
    if (random.below(8) == 0) ray.target = random.below(scene.triangles.count);
    return ray;
}

}  // namespace pl::test
