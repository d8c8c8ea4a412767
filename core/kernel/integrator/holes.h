// Rays through holes of surfaces: the ray is continued behind each hole until it meets a solid surface. Surfaces that blend are holes at
// random, with probability 1 - opacity: a decision for each ray and surface, as in GeometricPrimitive::Intersect() of pbrt-v4.   [Pharr,
// Jakob and Humphreys 2023, section 7.1.1]
#pragma once

#include <bit>

#include "core/kernel/base/hash.h"
#include "core/kernel/base/rng.h"
#include "core/kernel/geometry/intersector.h"
#include "core/kernel/shading/textured.h"

namespace pl {

/// Most holes in a row; the next one counts as solid. Bounds the time of files made of endless holes.
inline constexpr int kMostHoles = 1024;

/// A number in [0, 1), uniform over rays: a function of the bits of a ray and the number of a triangle alone, so that whoever traces the
/// ray decides alike.
PL_HD inline float number_of_hit(const Ray& ray, std::uint32_t primitive) {
    std::uint32_t hash = hash_word(0u, primitive);
    for (int axis = 0; axis < 3; ++axis) {
        hash = hash_word(hash, std::bit_cast<std::uint32_t>(ray.origin[axis]));
        hash = hash_word(hash, std::bit_cast<std::uint32_t>(ray.direction[axis]));
    }
    return to_unit_float(hash);
}

/// Whether a hit of the ray is to be ignored.
template <FeatureSet F>
PL_HD inline bool meets_hole(const SceneView& scene, const Ray& ray, const Hit& hit) {
    if constexpr (F.has(Feature::CutOuts)) {
        if (!hit.found()) return false;
        const float opacity = opacity_at<F>(scene, hit.primitive, hit_weights(hit));
        return opacity < 1.0f && (opacity <= 0.0f || number_of_hit(ray, hit.primitive) >= opacity);
    }
    return false;
}

/// The part of a ray beyond the hole it met. The ray keeps its end point if it has one.
template <FeatureSet F>
PL_HD inline Ray ray_behind(const SceneView& scene, const Ray& ray, const Hit& hit) {
    const SurfacePoint point = make_surface_point<F.common(kPlaceFeatures)>(scene, hit, -ray.direction);
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
        for (int i = 0; i < kMostHoles && meets_hole<F>(scene, rest, hit); ++i) {
            rest = ray_behind<F>(scene, rest, hit);
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
        if (!scene.opacities.empty()) return closest_solid_hit<F>(scene, intersector, ray).found();
    }
    return intersector.occluded(ray);
}

}  // namespace pl
