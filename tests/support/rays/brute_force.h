// The reference for every intersector: a test of each triangle.
#pragma once

#include <bit>

#include "core/kernel/geometry/intersector.h"

namespace pl::test {

inline Hit closest_hit_by_all(const SceneView& scene, const Ray& ray) {
    Hit best{.t = ray.t_max};
    const ScalarRaySpace space = make_ray_space(ray);
    for (std::uint32_t i = 0; i < scene.triangles.count; ++i) {
        if (i == ray.source || i == ray.target) continue;
        const Triangle& t = scene.triangles[i];
        intersect_triangle(space, scene.positions[t.v0], scene.positions[t.v1], scene.positions[t.v2], i, best);
    }
    return best;
}

/// Bitwise, so that NaN equals itself and 0 differs from -0.
inline bool same_bits(const Hit& a, const Hit& b) {
    return a.primitive == b.primitive && std::bit_cast<std::uint32_t>(a.t) == std::bit_cast<std::uint32_t>(b.t) &&
           std::bit_cast<std::uint32_t>(a.b1) == std::bit_cast<std::uint32_t>(b.b1) &&
           std::bit_cast<std::uint32_t>(a.b2) == std::bit_cast<std::uint32_t>(b.b2);
}

inline Vec3f hit_position(const Ray& ray, const Hit& hit) { return ray.origin + hit.t * ray.direction; }

}  // namespace pl::test
