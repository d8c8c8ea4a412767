// The ray-casting interface of the integrator, and its implementation over the scene's BVH.
#pragma once

#include <concepts>

#include "core/kernel/geometry/bvh_view.h"
#include "core/kernel/scene/scene_view.h"

namespace pl {

/// closest_hit: with 0 < t <= t_max, on ties the lowest primitive number. occluded: whether any hit exists in that
/// range. Both ignore Ray::source and Ray::target.
template <class T>
concept Intersector = requires(const T& intersector, const Ray& ray) {
    { intersector.closest_hit(ray) } -> std::same_as<Hit>;
    { intersector.occluded(ray) } -> std::same_as<bool>;
};

/// Traverses SceneView::bvh.
class BvhIntersector {
public:
    PL_HD explicit BvhIntersector(const SceneView& scene) : bvh_(scene.bvh) {}

    PL_HD Hit closest_hit(const Ray& ray) const { return find(ray, false); }
    PL_HD bool occluded(const Ray& ray) const { return find(ray, true).found(); }

private:
    PL_HD Hit find(const Ray& ray, bool any) const {
        Hit best{.t = ray.t_max};
        const ScalarRaySpace space = make_ray_space(ray);
        traverse(bvh_, ray, best, [&](const BvhTriangle& triangle, Hit& hit) {
            if (triangle.primitive == ray.source || triangle.primitive == ray.target) return false;
            intersect_triangle(space, triangle.p0, triangle.p1, triangle.p2, triangle.primitive, hit);
            return any && hit.found();
        });
        return best;
    }

    BvhView bvh_;
};
static_assert(Intersector<BvhIntersector>);

}  // namespace pl
