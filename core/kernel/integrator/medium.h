// The glass around a path, and its absorption. A path enters and leaves glass by refraction; glass whose back side it meets has been
// around it, however it came there.
#pragma once

#include "core/kernel/integrator/path.h"
#include "core/kernel/shading/bsdf.h"

namespace pl {

/// The glass around the end of a path's segment, or the origin of the next one; kNoMedium: none, or none that absorbs.
template <FeatureSet F, class M>
PL_HD inline std::uint32_t medium_of([[maybe_unused]] const PathState<F, M>& state) {
    if constexpr (kTracksMedium<F>)
        return state.medium;
    else
        return kNoMedium;
}

/// The medium beyond a surface in the direction wi; `medium` is that on the side of wo.
template <FeatureSet B>
PL_HD inline std::uint32_t medium_towards(const SurfacePoint& surface, const LayeredBsdf<B>& bsdf, Vec3f wi,
                                          std::uint32_t medium) {
    if (!bsdf.refracts() || glm::dot(wi, surface.geometric_normal) >= 0.0f) return medium;
    return surface.front ? surface.material : kNoMedium;
}

/// Absorption along the path's segment, which ends at `hit` or nowhere.
template <FeatureSet F, class M>
PL_HD_INLINED void absorb_segment([[maybe_unused]] const SceneView& scene, [[maybe_unused]] const Hit& hit,
                                  [[maybe_unused]] PathState<F, M>& state) {
    if constexpr (kTracksMedium<F>) {
        if (scene.absorption.empty()) return;
        std::uint32_t& medium = state.medium;
        if (hit.found()) {
            const FlatPrimitive flat = flat_primitive<F>(scene, hit.primitive);
            const bool is_front = glm::dot(flat.plane.normal, -state.ray.direction) >= 0.0f;
            if (!is_front && !is_black(scene.absorption[flat.material])) medium = flat.material;
        }
        if (medium == kNoMedium) return;
        const Vec3f share = transmittance(scene.absorption[medium], hit.t);
        state.throughput *= share;
        state.chain.weight *= share;
        state.survival *= max_component(share);
    }
}

/// Share of the light of a sample that comes through the medium along its shadow ray.
PL_HD inline Vec3f shadow_transmittance(const SceneView& scene, std::uint32_t medium, const Ray& ray) {
    if (scene.absorption.empty() || medium == kNoMedium) return Vec3f{1.0f};
    const float distance = ray.t_max < kInfinity ? ray.t_max * glm::length(ray.direction) : kInfinity;
    return transmittance(scene.absorption[medium], distance);
}

}  // namespace pl
