// A room with many kinds of lights, for tests of light samples in SIMD lanes.
#pragma once

#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "core/kernel/shading/bsdf.h"
#include "core/scene/pack_scene.h"
#include "tests/support/same_bits.h"
#include "tests/support/scenes/shapes.h"

namespace pl::test {

inline constexpr FeatureSet kRoomEffects =
    features(Feature::NextEventEstimation, Feature::DeltaLights, Feature::EnvironmentMap);

/// A vertex at a Lambert reflector.
struct RoomPoint {
    SurfacePoint surface;
    LambertBsdf bsdf;
};

/// A point, a spot and a directional light.
inline std::vector<PunctualLightDescription> delta_lights() {
    return {
        {.kind = PunctualKind::Point, .position = {0.2f, 0.4f, -0.3f}, .intensity = {3, 2, 1}},
        {.kind = PunctualKind::Spot, .position = {0, 0.9f, 0}, .direction = {0.1f, -1, 0.2f}, .intensity = {1, 2, 3}},
        {.kind = PunctualKind::Directional, .direction = {1, -2, 0.5f}, .intensity = {0.5f, 1, 0.2f}}};
}

/// A room with triangles that shine: small, large, edge-on, and one without area.
/// `third`: material number 2, of no triangle.
inline SceneDescription describe_room(int lights, std::vector<PunctualLightDescription> without_extent = {},
                                      MaterialDescription third = {}) {
    SceneDescription scene;
    scene.punctual_lights = std::move(without_extent);
    scene.materials = {gray(), gray(0.3f), std::move(third)};
    scene.materials[1].emission = glm::vec3{3.0f, 2.0f, 1.0f};
    add_box(scene, Vec3f{-1.0f}, Vec3f{1.0f}, true);
    Uniforms random(3);
    for (int i = 0; i < lights; ++i) {
        const Vec3f corner = random.cube(-0.9f, 0.9f);
        const float size = std::exp2(-static_cast<float>(random.below(12)));
        const Vec3f last = i == 2 ? corner : corner + size * random.direction();
        add_triangle(scene, corner, corner + size * random.direction(), last, 1);
    }
    return scene;
}
inline HostScene room_of_lights(int lights, std::vector<PunctualLightDescription> without_extent = {},
                                const MaterialDescription& third = {}) {
    return pack_scene(describe_room(lights, std::move(without_extent), third));
}

/// An environment map with dark texels and bright ones, of a size that is no power of two, and a sun.
inline EnvironmentMapDescription spotted_map() {
    EnvironmentMapDescription map{.width = 21, .height = 11, .rotation_deg = 77.0f};
    Uniforms random(4);
    for (int i = 0; i < 21 * 11; ++i) {
        const Vec3f radiance = random.cube(0.0f, 0.002f);
        map.texels.push_back(random.below(3) == 0 ? glm::vec3{radiance.x, radiance.y, radiance.z} : glm::vec3{0.0f});
    }
    return map;
}
inline SunDescription wide_sun() {
    return {.direction = {1, 2, -1}, .radiance = {0.02f, 0.015f, 0.01f}, .angle_deg = 20.0f};
}

/// A point on a surface, often on a light, seen from a random direction.
inline RoomPoint random_point(const SceneView& scene, Uniforms& random) {
    Vec3f b = random.cube(0.0f, 1.0f);
    b *= 1.0f / (b.x + b.y + b.z);
    const Vec3f wo = random.direction();
    RoomPoint point;
    point.surface = make_surface_point<kRoomEffects>(scene, random.below(scene.triangles.count), b, wo);
    point.bsdf = make_bsdf<kRoomEffects>(scene, point.surface, b, wo);
    return point;
}

inline Vec4f random_numbers(Uniforms& random) {
    const Vec3f u = random.cube(0.0f, 1.0f);
    return {u, random.next()};
}

inline bool same_ray(const Ray& a, const Ray& b) {
    return same_bits(a.origin, b.origin) && same_bits(a.direction, b.direction) && a.t_max == b.t_max &&
           a.source == b.source && a.target == b.target;
}

}  // namespace pl::test
