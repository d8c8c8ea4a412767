// Light sampling and its densities.
#pragma once

#include "core/kernel/base/warp.h"
#include "core/kernel/shading/bsdf.h"
#include "core/kernel/shading/near_light.h"

namespace pl {

/// Density of a light sample on an emitter of this material, per unit area. Lights are chosen in proportion to area
/// times luminance and points uniformly, so the area cancels.
PL_HD inline float light_pdf_area(const SceneView& scene, const Material& material) {
    return scene.light_power > 0.0f ? luminance(material.emission) / scene.light_power : 0.0f;
}

/// Converts a density per unit area at `on_light` to one per steradian at `from`, along the unit direction `wi`
/// between them.
template <class N>
PL_INLINE typename N::Real per_steradian(const typename N::Real& pdf_area, const Real3<N>& from,
                                         const SpawnPoint<N>& on_light, const Real3<N>& wi) {
    const auto cos_light = N::magnitude(dot(wi, on_light.normal));
    const Real3<N> segment = on_light.position - from;
    const auto pdf_sa = pdf_area * dot(segment, segment) / cos_light;
    return select(static_cast<typename N::Mask>(cos_light == 0.0f), N::constant(0.0f), pdf_sa);
}
PL_HD inline float per_steradian(float pdf_area, Vec3f from, const SurfacePoint& on_light, Vec3f wi) {
    return per_steradian<One>(pdf_area, unpack(from), spawn_point(on_light), unpack(wi));
}

/// Density per steradian at `from` of the samples on one light for the direction `wi` that hits it at `on_light`. `pdf_area` is
/// the density per unit area of uniform samples on it, times the probability of the light.
PL_HD inline float on_light_pdf_sa(const SceneView& scene, float pdf_area, Vec3f from, const SurfacePoint& on_light,
                                   Vec3f wi) {
    const SeenTriangle seen = see_triangle(scene, on_light.primitive, from);
    const float solid_angle = near_solid_angle(seen);
    return solid_angle > 0.0f ? pdf_area * seen.area / solid_angle : per_steradian(pdf_area, from, on_light, wi);
}

/// Samples a light by power; u in [0,1). Returns its index.
PL_HD inline std::uint32_t choose_light(const SceneView& scene, float u) {
    return find_interval(scene.lights.count, u,
                         [&](std::uint32_t light) { return scene.lights[light].cumulative_probability; });
}

/// Index of the light of an emissive triangle; of the next light, or the number of lights, for other triangles.
PL_HD inline std::uint32_t light_of(const SceneView& scene, std::uint32_t primitive) {
    return find_first(scene.lights.count,
                      [&](std::uint32_t light) { return scene.lights[light].primitive >= primitive; });
}

/// Density per unit area of uniform samples on the light at `on_light`, times the probability that light sampling at `from` chooses this
/// light. `learned`: of the point `from`.
template <FeatureSet F>
PL_HD inline float light_pdf_area(const SceneView& scene, [[maybe_unused]] Vec3f from, const SurfacePoint& on_light,
                                  [[maybe_unused]] LearnedLights learned) {
    if constexpr (F.has(Feature::ManyLights)) {
        if (!scene.light_tree.empty()) {
            const std::uint32_t light = light_of(scene, on_light.primitive);
            if (light >= scene.lights.count || scene.lights[light].primitive != on_light.primitive) return 0.0f;
            return light_probability(scene.light_tree, light, from, learned) *
                   scene.light_tree.of_light[light].pdf_area;
        }
    }
    return light_pdf_area(scene, scene.materials[on_light.material]);
}

/// Density per steradian of light sampling at `from` for the direction `wi` that hits `on_light`. `learned`: of the point `from`.
template <FeatureSet F = FeatureSet{}>
PL_HD inline float light_pdf_sa(const SceneView& scene, Vec3f from, const SurfacePoint& on_light, Vec3f wi,
                                LearnedLights learned = {}) {
    return on_light_pdf_sa(scene, light_pdf_area<F>(scene, from, on_light, learned), from, on_light, wi);
}

/// A surface point that lights are sampled for: its position, and the origin of rays that leave it. Near lights are seen from the
/// origin, as by a path that hits them: a density may change much from one to the other.
struct Receiver {
    Vec3f position{0.0f};
    Vec3f origin{0.0f};

    static PL_HD Receiver of(const SurfacePoint& surface) {
        return {surface.position, spawn_origin(surface, surface.geometric_normal)};
    }
};

/// A sampled point on a light.
struct LightPoint {
    SurfacePoint surface;
    Vec3f weights{0.0f};              ///< barycentric
    Vec3f from{0.0f};                 ///< the point that it is seen from
    float area_per_steradian = 0.0f;  ///< of a light that is sampled by solid angle, else 0
    float pdf_area = 0.0f;  ///< of uniform samples on the light: per unit area, times the probability of the light
    std::uint32_t cluster = kNoCluster;  ///< of the light; none without a light tree

    /// Density per steradian in the direction `wi` of the point.
    PL_HD float pdf_sa(Vec3f wi) const {
        return area_per_steradian > 0.0f ? pdf_area * area_per_steradian : per_steradian(pdf_area, from, surface, wi);
    }
};

/// Whether a point lies on the side of a light that its normal does not show to.
template <class N>
PL_INLINE typename N::Mask is_behind(const SpawnPoint<N>& on_light, const Real3<N>& from) {
    return dot(on_light.normal, from - on_light.position) < 0.0f;
}

/// The point of an emissive triangle at these barycentric weights, as seen from `from`.
PL_HD inline SurfacePoint light_surface(const SceneView& scene, std::uint32_t primitive, Vec3f weights, Vec3f from) {
    SurfacePoint point = make_surface_point<FeatureSet{}>(scene, primitive, weights, Vec3f{0.0f});
    if (is_behind(spawn_point(point), unpack(from))) {
        point.geometric_normal = -point.geometric_normal;
        point.front = false;
    }
    return point;
}

/// A point on a light, see sample_triangle(). Its pdf_area is left to the caller.
PL_HD inline LightPoint sample_on_light(const SceneView& scene, std::uint32_t light, const Receiver& receiver,
                                        Vec2f u) {
    const std::uint32_t primitive = scene.lights[light].primitive;
    const TriangleSample<One> sample = sample_triangle(see_triangle(scene, primitive, receiver.origin), unpack(u));
    LightPoint point{.surface = {},
                     .weights = pack(sample.weights),
                     .from = sample.area_per_steradian > 0.0f ? receiver.origin : receiver.position,
                     .area_per_steradian = sample.area_per_steradian};
    point.surface = light_surface(scene, primitive, point.weights, point.from);
    return point;
}

/// Chooses a light for the point `from`: by the tree if there is one, else by power, where its probability is left to
/// sample_chosen_light(). u in [0,1).
template <FeatureSet F>
PL_HD inline ChosenLight choose_light(const SceneView& scene, [[maybe_unused]] Vec3f from, float u,
                                      [[maybe_unused]] LearnedLights learned) {
    if constexpr (F.has(Feature::ManyLights)) {
        if (!scene.light_tree.empty()) return choose_light(scene.light_tree, from, u, learned);
    }
    return {.light = choose_light(scene, u)};
}

/// Samples a point on the light that choose_light() returned; u in [0,1)^2.
template <FeatureSet F>
PL_HD inline LightPoint sample_chosen_light(const SceneView& scene, const ChosenLight& chosen,
                                            const Receiver& receiver, Vec2f u) {
    LightPoint point = sample_on_light(scene, chosen.light, receiver, u);
    if constexpr (F.has(Feature::ManyLights)) {
        if (!scene.light_tree.empty()) {
            const LightPlace& place = scene.light_tree.of_light[chosen.light];
            point.pdf_area = chosen.probability * place.pdf_area;
            point.cluster = place.cluster;
            return point;
        }
    }
    point.pdf_area = light_pdf_area(scene, scene.materials[point.surface.material]);
    return point;
}

/// Samples a light and a point on it; u in [0,1)^3. The scene must have lights.
template <FeatureSet F = FeatureSet{}>
PL_HOST_APART PL_HD inline LightPoint sample_light(const SceneView& scene, const Receiver& receiver, Vec3f u,
                                                   LearnedLights learned = {}) {
    return sample_chosen_light<F>(scene, choose_light<F>(scene, receiver.position, u.x, learned), receiver,
                                  {u.y, u.z});
}

/// A light sample at a surface point (next-event estimation), without visibility.
struct DirectLight {
    SurfacePoint light;   ///< without a primitive: a far light, or a directional one
    Vec3f wi{0.0f};       ///< unit, from the surface to the light
    Vec3f emitted{0.0f};  ///< radiance of the light towards the surface
    float cos_i = 0.0f;
    float pdf_sa = 0.0f;                 ///< per steradian; 0: no contribution, even if visible
    std::uint32_t cluster = kNoCluster;  ///< of the light; none without a light tree, and of far lights
};

/// Emitted radiance of a point on a light with barycentric weights `b`, times its opacity: the mean over paths that would meet it or not.
template <FeatureSet F>
PL_HD inline Vec3f light_emitted(const SceneView& scene, const SurfacePoint& light, Vec3f b) {
    if constexpr (F.has(Feature::CutOuts)) {
        if (!scene.opacities.empty()) {
            const float opacity = opacity_at<F>(scene, light.primitive, b);
            return opacity > 0.0f ? opacity * emitted_at<F>(scene, light, b) : Vec3f{0.0f};
        }
    }
    return emitted_at<F>(scene, light, b);
}

/// Density per steradian of light sampling for a direction of the far lights.
PL_HD inline float far_light_pdf_sa(const SceneView& scene, Vec3f wi) {
    return scene.far_probability * far_pdf_sa(scene.far_lights, wi);
}

/// The light sample of a surface point by a sample of the far lights.
template <class B>
PL_HD inline DirectLight far_light_from(const SceneView& scene, const SurfacePoint& surface, const B& bsdf,
                                        const FarSample& far) {
    DirectLight sample{.light = {}, .wi = far.wi, .emitted = far.radiance};
    sample.cos_i = bsdf.cosine(surface, far.wi);
    if (sample.cos_i > 0.0f && !is_black(sample.emitted)) sample.pdf_sa = scene.far_probability * far.pdf_sa;
    return sample;
}

/// A sample of the delta lights: of at most kMostComparedLights neighbors in their list, one in proportion to the irradiance that it
/// brings if nothing occludes it.   [Chao 1982, weighted reservoir sampling with one number]
template <class B>
PL_HD inline DirectLight sample_delta_light(const SceneView& scene, const SurfacePoint& surface, const B& bsdf,
                                            Vec2f u) {
    const std::uint32_t count = scene.delta_lights.count;
    const std::uint32_t groups = (count + kMostComparedLights - 1) / kMostComparedLights;
    const std::uint32_t group = min_of(static_cast<std::uint32_t>(u.x * static_cast<float>(groups)), groups - 1);
    const std::uint32_t begin = group * kMostComparedLights;
    DirectLight sample;
    WayByNumber way{u.y};
    float total = 0.0f;
    float chosen = 0.0f;
    for (std::uint32_t i = begin; i < min_of(begin + kMostComparedLights, count); ++i) {
        const DeltaIllumination seen = illuminate(scene.delta_lights[i], surface.position);
        const float cos_i = bsdf.cosine(surface, seen.wi);
        const float irradiance = luminance(seen.irradiance) * cos_i;
        if (!(irradiance > 0.0f && kDeltaDensity * luminance(seen.irradiance) < kInfinity)) continue;
        total += irradiance;
        if (!way.takes_second(1.0f - irradiance / total)) continue;
        chosen = irradiance;
        sample.wi = seen.wi;
        sample.emitted = kDeltaDensity * seen.irradiance;
        sample.cos_i = cos_i;
        const bool has_position = scene.delta_lights[i].kind != DeltaLightKind::Directional;
        sample.light.position = scene.delta_lights[i].position;
        sample.light.primitive = has_position ? kDeltaLightTarget : kNoPrimitive;
    }
    // Without a normal shadow rays end in the very position.
    sample.light.geometric_normal = Vec3f{0.0f};
    if (total > 0.0f) {
        const float probability = scene.delta_probability / static_cast<float>(groups) * (chosen / total);
        sample.pdf_sa = kDeltaDensity * probability;
    }
    return sample;
}

/// The light sample of a surface point at a sampled point on a light.
template <FeatureSet F, class B>
PL_HD inline DirectLight direct_light_from(const SceneView& scene, const SurfacePoint& surface, const B& bsdf,
                                           const LightPoint& point) {
    DirectLight sample{.light = point.surface, .cluster = point.cluster};
    const Vec3f segment = sample.light.position - point.from;
    const float distance2 = glm::dot(segment, segment);
    if (!(distance2 > 0.0f) || sample.light.primitive == surface.primitive) return {};
    sample.wi = segment * (1.0f / std::sqrt(distance2));
    sample.cos_i = bsdf.cosine(surface, sample.wi);
    sample.emitted = light_emitted<F>(scene, sample.light, point.weights);
    if (sample.cos_i > 0.0f && !is_black(sample.emitted)) sample.pdf_sa = point.pdf_sa(sample.wi);
    return sample;
}

/// Light sample for a surface point; u.x, u.y, u.z in [0,1), u.w in [0, 1) selects far lights or emissive triangles. `learned`: of
/// the point. The caller traces the shadow ray.
template <FeatureSet F = FeatureSet{}, class B>
PL_HOST_APART PL_HD inline DirectLight sample_direct_light(const SceneView& scene, const SurfacePoint& surface,
                                                           const B& bsdf, Vec4f u, LearnedLights learned = {}) {
    if constexpr (F.has(Feature::DeltaLights)) {
        if (scene.delta_probability > 0.0f) {
            // u.z chooses: unlike u.w it is spread evenly over the passes, and no other estimator makes up for missing samples.
            const float others = 1.0f - scene.delta_probability;
            WayByNumber way{u.z};
            if (way.takes_second(others)) return sample_delta_light(scene, surface, bsdf, {u.x, u.y});
            u.z = way.u;
            u.w *= others;
        }
    }
    if constexpr (F.has(Feature::EnvironmentMap)) {
        if (u.w < scene.far_probability)
            return far_light_from(scene, surface, bsdf, sample_far(scene.far_lights, {u.x, u.y}, u.z));
    }
    if (scene.lights.empty()) return {};
    return direct_light_from<F>(scene, surface, bsdf,
                                sample_light<F>(scene, Receiver::of(surface), Vec3f{u}, learned));
}

/// The shadow ray of a light sample.
template <FeatureSet F>
PL_HD inline Ray shadow_ray_to(const SurfacePoint& surface, const DirectLight& sample) {
    if constexpr (F.has_any(features(Feature::EnvironmentMap, Feature::DeltaLights))) {
        if (sample.light.primitive == kNoPrimitive) return spawn_ray(surface, sample.wi);
    }
    return spawn_shadow_ray(surface, sample.light);
}

/// Balance heuristic for two strategies with one sample each; densities in the same measure. A ratio, so that huge
/// densities cannot overflow.   [Veach 1997, eq. 9.8]
template <class N>
PL_INLINE typename N::Real balance_weight(const typename N::Real& own_pdf, const typename N::Real& other_pdf) {
    const auto weight = 1.0f / (1.0f + other_pdf / own_pdf);
    return select(static_cast<typename N::Mask>(own_pdf > 0.0f), weight, N::constant(0.0f));
}
PL_HD inline float balance_weight(float own_pdf, float other_pdf) {
    return own_pdf > 0.0f ? balance_weight<One>(own_pdf, other_pdf) : 0.0f;
}

}  // namespace pl
