// Density of light samples over all directions, which integrates to 1 where no light hides another.
#pragma once

#include "core/kernel/geometry/intersector.h"
#include "core/kernel/shading/lights.h"
#include "tests/support/scenes/shapes.h"
#include "tests/support/statistics/moments.h"

namespace pl::test {

/// 4 pi times the density at the origin, of 4e6 uniform directions of seed 2: its mean is the integral.
template <FeatureSet F = FeatureSet{}>
Moments density_over_sphere(const SceneView& scene) {
    const BvhIntersector intersector{scene};
    Uniforms random(2);
    Moments moments;
    for (int i = 0; i < 4000000; ++i) {
        const Ray ray{.origin = Vec3f{0.0f}, .direction = random.direction()};
        const Hit hit = intersector.closest_hit(ray);
        double density = 0.0;
        if (hit.found()) {
            const SurfacePoint on_light = make_surface_point<FeatureSet{}>(scene, hit, -ray.direction);
            density = static_cast<double>(light_pdf_sa<F>(scene, ray.origin, on_light, ray.direction));
        }
        moments.add(density * 4.0 * 3.14159265358979323846);
    }
    return moments;
}

}  // namespace pl::test
