// Random walks inside closed scenes, and counts of their failures.
#pragma once

#include "core/kernel/geometry/intersector.h"
#include "core/kernel/shading/lambert.h"
#include "tests/support/scenes/shapes.h"

namespace pl::test {

struct WalkResult {
    std::uint64_t segments = 0;
    std::uint64_t escapes = 0;  ///< segments that hit nothing
    std::uint64_t leaks = 0;    ///< segments that hit a surface from behind
};

/// How hard the directions of a walk are.
enum class WalkStyle {
    Diffuse,      ///< cosine-distributed directions, as paths have
    Adversarial,  ///< every second vertex is moved next to an edge or a corner, every fourth direction grazes
};

/// Weights that are small for one or two corners, down to 2^-40.
inline void move_to_edge(Hit& hit, Uniforms& random) {
    const auto tiny = [&] { return std::ldexp(random.next(), -1 - static_cast<int>(random.below(40))); };
    float b[3];
    const auto first = static_cast<std::size_t>(random.below(3));
    b[first] = tiny();
    b[(first + 1) % 3] = random.below(2) == 0 ? tiny() : (1.0f - b[first]) * random.next();
    b[(first + 2) % 3] = max_of(1.0f - b[first] - b[(first + 1) % 3], 0.0f);
    hit.b1 = b[1];
    hit.b2 = b[2];
}

/// Flattens a direction towards the surface, to 1/1000 at most.
inline Vec3f grazing(const SurfacePoint& point, Vec3f direction, Uniforms& random) {
    const Frame frame = make_frame(point.geometric_normal);
    Vec3f local = frame.to_local(direction);
    local.z *= std::exp2(-10.0f * random.next());
    return glm::normalize(frame.to_world(local));
}

/// A walk from `start` that begins anew there when it has escaped. Fronts must look inwards for leaks to be counted.
template <Intersector I>
WalkResult walk(const SceneView& scene, const I& intersector, Vec3f start, std::uint64_t segments, WalkStyle style,
                std::uint64_t seed) {
    Uniforms random(seed);
    WalkResult result;
    const auto restart = [&] { return Ray{.origin = start, .direction = random.direction()}; };
    Ray ray = restart();
    for (; result.segments < segments; ++result.segments) {
        Hit hit = intersector.closest_hit(ray);
        const Vec3f wo = -ray.direction;
        if (!hit.found() || !(glm::dot(scene.planes[hit.primitive].normal, wo) >= 0.0f)) {
            ++(hit.found() ? result.leaks : result.escapes);
            ray = restart();
            continue;
        }
        if (style != WalkStyle::Diffuse && random.below(2) == 0) move_to_edge(hit, random);
        const SurfacePoint point = make_surface_point<FeatureSet{}>(scene, hit, wo);
        Vec3f direction = lambert_sample(point, random.square());
        if (style == WalkStyle::Adversarial && random.below(4) == 0) direction = grazing(point, direction, random);
        ray = glm::dot(direction, point.geometric_normal) > 0.0f ? spawn_ray(point, direction) : restart();
    }
    return result;
}

}  // namespace pl::test
