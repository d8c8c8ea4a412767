// The ray-casting interface of the integrator, and its implementation over the scene's BVH.
#pragma once

#include <concepts>

#include "core/kernel/base/features.h"
#include "core/kernel/base/type_list.h"
#include "core/kernel/geometry/bvh_view.h"
#include "core/kernel/geometry/instance_traversal.h"
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

/// Goes on from find_hit() with the instances of a scene.
PL_HD_APART void find_instance_hit(const InstancesView& instances, const Ray& ray, bool any, Hit& best) {
    if (any && best.found()) return;
    const ScalarRaySpace space = make_ray_space(ray);
    traverse_instances(instances, ray, best, [&](Vec3f p0, Vec3f p1, Vec3f p2, std::uint32_t primitive, Hit& hit) {
        if (primitive == ray.source || primitive == ray.target) return false;
        intersect_triangle(space, p0, p1, p2, primitive, hit);
        return any && hit.found();
    });
}

/// Traverses SceneView::bvh and, for sets of effects with Instances, SceneView::instances.
template <FeatureSet F>
class BvhIntersectorOf {
public:
    PL_HD explicit BvhIntersectorOf(const SceneView& scene) : bvh_(scene.bvh), instances_(scene.instances) {}

    PL_HD Hit closest_hit(const Ray& ray) const { return find(ray, false); }
    PL_HD bool occluded(const Ray& ray) const { return find(ray, true).found(); }

private:
    PL_HD Hit find(const Ray& ray, bool any) const {
        Hit best = find_hit(bvh_, ray, any);
        if constexpr (F.has(Feature::Instances)) {
            if (!instances_.empty()) find_instance_hit(instances_, ray, any, best);
        }
        return best;
    }

    BvhView bvh_;
    [[no_unique_address]] MemberIf<F.has(Feature::Instances), InstancesView> instances_;
};
/// For any scene.
using BvhIntersector = BvhIntersectorOf<kEveryFeature>;
static_assert(Intersector<BvhIntersector>);

}  // namespace pl
