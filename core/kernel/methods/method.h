// A method: how the next direction of a path is sampled, and how a guiding field is trained by the path. The integrator is a
// template over it; no virtual calls, no run-time switches.
#pragma once

#include <concepts>

#include "core/kernel/guiding/direction_sample.h"
#include "core/kernel/methods/learning_target.h"
#include "core/kernel/shading/bsdf.h"

namespace pl {

/// BSDF sampling of a Lambert reflector: the densities of a given direction.
PL_HD inline DirectionSample weigh_lambert(const SurfacePoint& surface, Vec3f wi) {
    const float pdf_sa = lambert_pdf_sa(surface, wi);
    return {wi, pdf_sa, pdf_sa};
}

/// BSDF sampling of any other surface, by numbers.u.y, u.z and numbers.lobe.
template <FeatureSet B>
PL_HD inline DirectionSample sample_bsdf(const SurfacePoint& surface, const LayeredBsdf<B>& bsdf,
                                         const ScatterUniforms& uniforms) {
    const Vec3f wi = bsdf.sample(surface, {uniforms.u.y, uniforms.u.z}, uniforms.lobe);
    const float pdf_sa = bsdf.pdf_sa(surface, wi);
    return {wi, pdf_sa, pdf_sa};
}

/// The end of a path's segment for the vertex that scattered it: reward and next state of reinforcement learning.
struct Observation {
    Vec3f emitted{0.0f};  ///< radiance emitted towards that vertex, or the environment's
    Vec3f albedo{0.0f};   ///< reflectance of the surface hit; 0 on a miss
    /// MIS share of `emitted` of scattered directions; light samples at that vertex have the rest.
    float direction_share = 1.0f;
    float distance = kInfinity;  ///< scene units
};

/// A light sample at a vertex, with its MIS weight, if nothing occludes the light.
struct LightEstimate {
    Vec3f reflected{0.0f};               ///< radiance reflected there towards the path's last vertex with a location
    float irradiance = 0.0f;             ///< rms() of irradiance / pi
    std::uint32_t cluster = kNoCluster;  ///< of the light, see LightTree; none if the estimate is 0
};

/// The scattering of a path at a vertex.
struct ScatterEvent {
    Vec3f weight{0.0f};  ///< f cos / pdf, times the weight of Russian roulette
    Vec3f albedo{0.0f};
    DirectionSample direction;
};

/// Events that a method counts.
template <class Count>
struct MethodCountersOf {
    Count records = 0;          ///< training samples
    Count clamped_records = 0;  ///< training samples whose target exceeds the range of the pending sums
    Count lookups = 0;
    Count lookup_misses = 0;  ///< lookups without a location
    Count cut_returns = 0;    ///< Monte-Carlo returns of paths with more vertices than their memory holds
};
using MethodCounters = MethodCountersOf<std::uint64_t>;

/// The training hooks of a method that does not learn: each does nothing and compiles to nothing. The integrator
/// calls them in this order; a method that learns derives from this and hides the types and the hooks it needs.
///
///        segment traced ----> miss -----------------> observe --------------------+
///              |                                                                   |
///             hit -> locate -> observe -+-> surface does not scatter --------------+
///              ^                        v                                          |
///              |      light_sampled (if lights are sampled; or after the roulette)  |
///              |                        v                                          v
///              |            estimate_contribution ---> roulette ends it: terminated -> finished
///              |                        v
///              +-- scattered <--- sample_direction          (record_light, before it light_received if the light is
///                                                            visible: any time after light_sampled, before the
///                                                            next observe)
struct MethodHooks {
    struct Vertex {};  ///< data of a surface point, e.g. its location in a field
    struct Memory {};  ///< part of the path's state: training samples whose targets are not complete
    struct Store {
    };  ///< the larger part of Memory, kept outside of the path's state: given to it by keep(Store*) if not empty
    struct Sample {};       ///< a complete training sample made by observe(), added by record() before the pass ends
    struct Light {};        ///< a light sample made by light_sampled(), added by record_light() before the pass ends
    struct Expectation {};  ///< part of the path's state: the contribution expected at its first vertex

    static constexpr bool kLearnsLights = false;  ///< whether learned_lights() chooses among many lights
    static constexpr bool kIsConstant = false;    ///< whether it is guided by a field that it does not train

    /// Whether the integrator serves these settings of its method.
    static constexpr bool serves(const LearningSettings&) { return true; }

    PL_HD Vertex locate(const SurfacePoint&, MethodCounters&) const { return {}; }
    PL_HD Sample observe(auto&, const Observation&, const auto& /*vertex*/, MethodCounters&) const { return {}; }
    PL_HD void record(const Sample&) const {}
    /// Called for light samples that cannot contribute, too: their estimate is 0.
    PL_HD Light light_sampled(auto&, const auto& /*vertex*/, const LightEstimate&) const { return {}; }
    PL_HD void record_light(const Light&, bool /*is_visible*/) const {}
    PL_HD void light_received(auto&, MethodCounters&) const {}
    /// Contribution estimate: the radiance, rms() of its channels, still expected of the path as a share of the
    /// radiance expected at its first vertex. `survival`: the product of the albedos so far over the product of the
    /// survival probabilities, the estimate of a method without a field. Called once per vertex.
    PL_HD float estimate_contribution(const auto&, Vec3f /*albedo*/, Vec3f /*throughput*/, float survival,
                                      auto&) const {
        return survival;
    }
    PL_HD void scattered(auto&, const auto& /*vertex*/, const ScatterEvent&, MethodCounters&) const {}
    /// Roulette, the depth limit or a zero-valued direction ended the path at a vertex that reflects.
    PL_HD void terminated(auto&, MethodCounters&) const {}
    /// The path has ended, and its last light sample is connected.
    PL_HD void finished(auto&, MethodCounters&) const {}
};

/// sample_direction() and pdf_sa() have two overloads: for Lambert reflectors, and with a LayeredBsdf for all other
/// surfaces.
template <class M>
concept Method = std::derived_from<M, MethodHooks> &&
    requires(const M& method, const typename M::Vertex& vertex, typename M::Memory& memory,
             const SurfacePoint& surface, const Bsdf<kLobeFeatures>& bsdf, const Bsdf<kEveryFeature>& every,
             const ScatterUniforms& uniforms, Vec3f wi, const Observation& observation, MethodCounters& counters,
             typename M::Expectation& expectation) {
    { method.sample_direction(vertex, surface, uniforms) } -> std::same_as<DirectionSample>;
    { method.pdf_sa(vertex, surface, wi) } -> std::same_as<float>;
    { method.sample_direction(vertex, surface, bsdf, uniforms) } -> std::same_as<DirectionSample>;
    { method.pdf_sa(vertex, surface, bsdf, wi) } -> std::same_as<float>;
    { method.sample_direction(vertex, surface, every, uniforms) } -> std::same_as<DirectionSample>;
    { method.pdf_sa(vertex, surface, every, wi) } -> std::same_as<float>;
    { method.locate(surface, counters) } -> std::same_as<typename M::Vertex>;
    { method.observe(memory, observation, vertex, counters) } -> std::same_as<typename M::Sample>;
    { method.record(typename M::Sample{}) } -> std::same_as<void>;
    { method.estimate_contribution(vertex, wi, wi, float{}, expectation) } -> std::same_as<float>;
    { method.light_sampled(memory, vertex, LightEstimate{}) } -> std::same_as<typename M::Light>;
    method.record_light(typename M::Light{}, bool{});
    method.light_received(memory, counters);
    method.scattered(memory, vertex, ScatterEvent{}, counters);
    method.terminated(memory, counters);
    method.finished(memory, counters);
};

}  // namespace pl
