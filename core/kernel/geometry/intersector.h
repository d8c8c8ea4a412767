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

/// The closest hit, or with `any` the first found, by one of the overloads of traverse(). In these nothing depends on the order of
/// the tests: all have the same bits.
template <class Hierarchy>
PL_HD inline Hit find_hit(const Hierarchy& hierarchy, const Ray& ray, bool any) {
    Hit best{.t = ray.t_max};
    const ScalarRaySpace space = make_ray_space(ray);
    traverse(hierarchy, ray, best, [&](const BvhTriangle& triangle, Hit& hit) {
        if (triangle.primitive == ray.source || triangle.primitive == ray.target) return false;
        intersect_triangle(space, triangle.p0, triangle.p1, triangle.p2, triangle.primitive, hit);
        return any && hit.found();
    });
    return best;
}

/// Traverses SceneView::bvh.
class BvhIntersector {
public:
    PL_HD explicit BvhIntersector(const SceneView& scene) : bvh_(scene.bvh) {}

    PL_HD Hit closest_hit(const Ray& ray) const { return find_hit(bvh_, ray, false); }
    PL_HD bool occluded(const Ray& ray) const { return find_hit(bvh_, ray, true).found(); }

private:
    BvhView bvh_;
};
static_assert(Intersector<BvhIntersector>);

}  // namespace pl
