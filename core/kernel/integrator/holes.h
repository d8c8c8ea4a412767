// Rays through holes of surfaces: the ray is continued behind each hole until it meets a solid surface.
#pragma once

#include "core/kernel/geometry/intersector.h"
#include "core/kernel/shading/textured.h"

namespace pl {

/// Most holes in a row; the next one counts as solid. Bounds the time of files made of endless holes.
inline constexpr int kMostHoles = 1024;

template <FeatureSet F>
PL_HD inline bool meets_hole(const SceneView& scene, const Hit& hit) {
    if constexpr (F.has(Feature::CutOuts))
        return hit.found() && is_hole_at<F>(scene, hit.primitive, hit_weights(hit));
    return false;
}

/// The part of a ray beyond the hole it met. The ray keeps its end point if it has one.
PL_HD inline Ray ray_behind(const SceneView& scene, const Ray& ray, const Hit& hit) {
    const SurfacePoint point = make_surface_point<FeatureSet{}>(scene, hit, -ray.direction);
    Ray rest = ray;
    rest.origin = spawn_origin(point, ray.direction);
    rest.source = hit.primitive;
    if (ray.t_max < kInfinity) {
        rest.direction = ray.origin + ray.t_max * ray.direction - rest.origin;
        rest.t_max = 1.0f;
    }
    return rest;
}

/// The closest hit that is no hole; its distance is measured from the ray's origin if the direction is unit.
template <FeatureSet F, Intersector I>
PL_HD inline Hit closest_solid_hit(const SceneView& scene, const I& intersector, const Ray& ray) {
    Hit hit = intersector.closest_hit(ray);
    if constexpr (F.has(Feature::CutOuts)) {
        Ray rest = ray;
        float passed = 0.0f;
        for (int i = 0; i < kMostHoles && meets_hole<F>(scene, hit); ++i) {
            rest = ray_behind(scene, rest, hit);
            passed += hit.t;
            hit = intersector.closest_hit(rest);
        }
        if (passed > 0.0f) hit.t += passed;
    }
    return hit;
}

/// Whether a solid surface blocks a shadow ray.
template <FeatureSet F, Intersector I>
PL_HD inline bool is_blocked(const SceneView& scene, const I& intersector, const Ray& ray) {
    if constexpr (F.has(Feature::CutOuts)) {
        if (scene.textures.has_holes != 0) return closest_solid_hit<F>(scene, intersector, ray).found();
    }
    return intersector.occluded(ray);
}

}  // namespace pl
