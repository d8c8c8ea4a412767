// Hard cases for intersectors: rays along axes, at edges and corners, from surfaces, with finite t_max.
#pragma once

#include <vector>

#include "core/kernel/base/warp.h"
#include "cpu/base/ray_batch.h"
#include "tests/support/rays/brute_force.h"
#include "tests/support/scenes/shapes.h"

namespace pl::test {

inline Vec3f corner(const SceneView& scene, std::uint32_t primitive, std::uint32_t which) {
    const Triangle& t = scene.triangles[primitive];
    const std::uint32_t corners[] = {t.v0, t.v1, t.v2};
    return scene.positions[corners[which]];
}

/// A point of a triangle: inside, on an edge, or a corner.
inline Vec3f point_on(const SceneView& scene, std::uint32_t primitive, Uniforms& random) {
    const std::uint32_t first = random.below(3);
    const Vec3f a = corner(scene, primitive, first);
    const Vec3f b = corner(scene, primitive, (first + 1) % 3);
    const Vec3f c = corner(scene, primitive, (first + 2) % 3);
    switch (random.below(3)) {
    case 0: return a;
    case 1: return glm::mix(a, b, random.next());
    default: {
        const Vec2f weights = square_to_triangle(random.square());
        return a + weights.x * (b - a) + weights.y * (c - a);
    }
    }
}

inline Vec3f random_direction(Uniforms& random) {
    if (random.below(8) != 0) return random.direction();
    Vec3f axis{0.0f};
    axis[static_cast<int>(random.below(3))] = random.below(2) == 0 ? 1.0f : -1.0f;
    return axis;
}

/// A ray in a random direction or towards a triangle; its origin is in [-2,2]^3 or on a triangle, which it excludes.
inline Ray random_ray(const SceneView& scene, Uniforms& random) {
    Ray ray{.origin = random.cube(-2.0f, 2.0f), .direction = random_direction(random)};
    const std::uint32_t triangles = scene.triangles.count;
    if (triangles == 0) return ray;
    if (random.below(2) == 0) {
        ray.source = random.below(triangles);
        ray.origin = point_on(scene, ray.source, random);
    }
    if (random.below(2) == 0) {
        const std::uint32_t aim = random.below(triangles);
        const Vec3f end = point_on(scene, aim, random);
        if (end != ray.origin) ray.direction = end - ray.origin;
        ray.t_max = random.below(2) == 0 ? 1.0f : random.between(0.5f, 2.0f);
        if (random.below(2) == 0) ray.target = aim;
    }
    return ray;
}

inline std::vector<Ray> random_rays(const SceneView& scene, std::size_t count, std::uint64_t seed) {
    Uniforms random(seed);
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < count; ++i) rays.push_back(random_ray(scene, random));
    return rays;
}

/// Closest hits and occlusion of all rays.
template <BatchIntersector I>
RayBatch find_all(const I& intersector, const std::vector<Ray>& rays) {
    const auto count = static_cast<std::uint32_t>(rays.size());
    RayBatch batch(count);
    for (std::uint32_t i = 0; i < count; ++i) batch.set_ray(i, rays[i]);
    intersector.find_closest(batch, count);
    intersector.find_occluded(batch, count);
    return batch;
}

}  // namespace pl::test
