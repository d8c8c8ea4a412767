// Scenes of many lights, and their unoccluded irradiance.
#pragma once

#include "core/kernel/shading/lights.h"
#include "core/scene/pack_scene.h"
#include "tests/support/scenes/shapes.h"
#include "tests/support/statistics/moments.h"

namespace pl::test {

inline constexpr FeatureSet kMany = features(Feature::ManyLights);
inline constexpr std::uint32_t kLights = 200;

/// Small triangles all over a cube of side 4, of very different power; every tenth emits from both sides.
inline SceneDescription scattered_lights(float scale = 1.0f) {
    SceneDescription scene;
    scene.materials.assign(40, gray());
    Uniforms random(7);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        scene.materials[i].emission = Vec3f{std::pow(10.0f, random.between(-1.5f, 1.5f))};
        scene.materials[i].two_sided_emission = i % 10 == 0;
    }
    for (std::uint32_t i = 0; i < kLights; ++i) {
        const Vec3f center = random.cube(-2, 2);
        const auto corner = [&] { return scale * (center + random.cube(-0.1f, 0.1f)); };
        const Vec3f a = corner();
        const Vec3f b = corner();
        add_triangle(scene, a, b, corner(), i % 40);
    }
    return scene;
}

inline SurfacePoint receiver_at(Vec3f position, Vec3f normal) {
    SurfacePoint point;
    point.position = position;
    point.geometric_normal = point.shading_normal = normal;
    return point;
}

/// Irradiance at a surface by unoccluded light samples, and the variance of one of them.
template <FeatureSet F>
inline Moments irradiance(const SceneView& scene, const SurfacePoint& surface, int samples) {
    Uniforms random(9);
    Moments moments;
    for (int i = 0; i < samples; ++i) {
        const Vec3f u{random.next(), random.next(), random.next()};
        const DirectLight light = sample_direct_light<F>(scene, surface, LambertBsdf{}, Vec4f{u, 0.0f});
        moments.add(light.pdf_sa > 0.0f ? static_cast<double>(light.emitted.x * light.cos_i / light.pdf_sa) : 0.0);
    }
    return moments;
}

/// The same as a sum over a grid of points on every light.
inline double summed_irradiance(const SceneView& scene, const SurfacePoint& surface) {
    constexpr int kSide = 64;
    double sum = 0.0;
    for (std::uint32_t light = 0; light < scene.lights.count; ++light) {
        const Triangle& t = scene.triangles[scene.lights[light].primitive];
        const float area = 0.5f * glm::length(glm::cross(scene.positions[t.v1] - scene.positions[t.v0],
                                                         scene.positions[t.v2] - scene.positions[t.v0]));
        for (int i = 0; i < kSide * kSide; ++i) {
            const Vec2f u = (Vec2f{static_cast<float>(i % kSide), static_cast<float>(i / kSide)} + 0.5f) *
                            (1.0f / static_cast<float>(kSide));
            const SurfacePoint point =
                light_surface(scene, scene.lights[light].primitive, sample_weights(u), surface.position);
            const Vec3f segment = point.position - surface.position;
            const float distance2 = glm::dot(segment, segment);
            const Vec3f wi = segment / std::sqrt(distance2);
            const Vec3f emitted = emitted_radiance(scene.materials[point.material], point.front);
            const float cosines = max_of(glm::dot(wi, surface.geometric_normal), 0.0f) *
                                  std::fabs(glm::dot(wi, point.geometric_normal));
            sum += static_cast<double>(emitted.x * cosines * area / distance2) / (kSide * kSide);
        }
    }
    return sum;
}

}  // namespace pl::test
