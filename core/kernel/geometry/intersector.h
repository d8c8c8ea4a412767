// What the integrator asks of ray tracing, and the implementation over our own hierarchy.
#pragma once

#include <concepts>

#include "core/kernel/geometry/bvh_view.h"
#include "core/kernel/scene/scene_view.h"

namespace pl {

/// Finds the closest hit with 0 < t <= t_max (lowest number on ties), or whether anything lies in between.
template <class T>
concept Intersector = requires(const T& intersector, const Ray& ray) {
    { intersector.closest_hit(ray) } -> std::same_as<Hit>;
    { intersector.occluded(ray) } -> std::same_as<bool>;
};

/// Traverses the scene's own hierarchy.
struct BvhIntersector {
    SceneView scene;

    PL_HD Hit closest_hit(const Ray& ray) const { return find(ray, false); }
    PL_HD bool occluded(const Ray& ray) const { return find(ray, true).found(); }

private:
    PL_HD Hit find(const Ray& ray, bool any) const {
        Hit best{.t = ray.t_max};
        const ScalarRaySpace space = make_ray_space(ray);
        traverse(scene.bvh, ray, best, [&](std::uint32_t primitive, Hit& hit) {
            if (primitive == ray.source || primitive == ray.target) return false;
            const Triangle& triangle = scene.triangles[primitive];
            intersect_triangle(space, scene.positions[triangle.v0], scene.positions[triangle.v1],
                               scene.positions[triangle.v2], primitive, hit);
            return any && hit.found();
        });
        return best;
    }
};
static_assert(Intersector<BvhIntersector>);

}  // namespace pl
