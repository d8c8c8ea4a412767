// The state of one path between two steps, its settings and its counters.
#pragma once

#include <cstdint>
#include <type_traits>

#include "core/kernel/base/features.h"
#include "core/kernel/base/rng.h"
#include "core/kernel/base/type_list.h"
#include "core/kernel/film/sample_variance.h"
#include "core/kernel/film/vertex_sequence.h"
#include "core/kernel/methods/method.h"
#include "core/kernel/shading/absorption.h"
#include "core/kernel/shading/light_tree.h"

namespace pl {

/// Source of the contribution estimate that decides roulette. The product of albedos is always available; the estimate by a guiding
/// field is more precise, but may be wrong.
enum class RouletteRule : std::uint32_t {
    Spare,   ///< the field's estimate may keep a path, but not end it sooner than the albedos alone would
    Albedo,  ///< the albedos alone
};

/// The settings of paths besides scene, camera and method.
struct PathSettings {
    std::uint64_t seed = 1;
    Stream stream = Stream::Picture;
    VertexSequences sequences{};
    std::uint32_t max_depth = 64;  ///< most surface vertices of a path; longer ones are truncated and counted
    std::uint32_t roulette_start =
        3;  ///< vertices after which Russian roulette may end a path, see counted_vertices()
    float roulette_threshold = 1.0f;  ///< contribution estimate below which a path plays roulette
    RouletteRule roulette = RouletteRule::Spare;
    std::uint32_t next_event = 0;  ///< 1: sample lights at every vertex, combined by multiple importance sampling
};

/// The parameters common to all paths of a pass.
template <class M>
struct PathContext {
    const SceneView& scene;
    const M& method;
    const PathSettings& settings;
};

/// The specular chain since the last vertex with a location: mirrors and glass have none and pass radiance on.
struct SpecularChain {
    Vec3f weight{1.0f};   ///< product of f cos / pdf, and of roulette weights, along the chain
    Vec3f emitted{0.0f};  ///< radiance emitted by its surfaces, as seen from that vertex
    float distance = 0.0f;
    bool is_open = false;  ///< the chain has at least one vertex
};

/// Whether paths know the glass around them, see medium.h.
template <FeatureSet F>
inline constexpr bool kTracksMedium = F.has(Feature::Absorption) && F.has_any(kLobeFeatures);

/// Whether paths of this method choose lights by the learned irradiance of clusters, in scenes with a light tree.
template <FeatureSet F, class M>
inline constexpr bool learns_lights = F.has(Feature::ManyLights) && M::kLearnsLights;

template <FeatureSet F, class M>
struct PathState {
    Ray ray;                        ///< the segment to trace next
    Vec3f throughput{1.0f};         ///< product of f cos / pdf, and of roulette weights
    Vec3f radiance{0.0f};           ///< of the path's estimator so far
    float direction_pdf_sa = 0.0f;  ///< density of ray.direction; 0 if no light was sampled at its origin
    float survival = 1.0f;          ///< product of albedos over the survival probabilities so far
    std::uint32_t pixel = 0;        ///< or the probe's number
    std::uint32_t sample = 0;
    std::uint32_t vertices = 0;  ///< surface vertices so far, and so the index of the current one's random numbers
    [[no_unique_address]] MemberIf<F.has_any(kLobeFeatures), SpecularChain> chain{};
    /// Until the path first plays roulette, up to a limit.
    [[no_unique_address]] MemberIf<F.has_any(kLobeFeatures), std::uint32_t> specular_vertices{};
    [[no_unique_address]] MemberIf<kTracksMedium<F>, std::uint32_t, 1> medium{
        kNoMedium};  ///< material of the glass around it
    [[no_unique_address]] MemberIf<learns_lights<F, M>, LearnedLights>
        lights{};  ///< at the vertex of direction_pdf_sa
    [[no_unique_address]] typename M::Memory memory{};
    [[no_unique_address]] typename M::Expectation expectation{};
};

/// The choice of lights that was learned for the path's last vertex.
template <FeatureSet F, class M>
PL_HD inline LearnedLights learned_lights([[maybe_unused]] const PathState<F, M>& state) {
    if constexpr (learns_lights<F, M>)
        return state.lights;
    else
        return {};
}

/// Whether the method's Memory has a part outside of the path's state, which the driver of the path provides.
template <class M>
inline constexpr bool kNeedsStore = !std::is_empty_v<typename M::Store>;

template <FeatureSet F, class M>
PL_HD inline void keep_store(PathState<F, M>& state, [[maybe_unused]] typename M::Store* store) {
    if constexpr (kNeedsStore<M>) state.memory.keep(store);
}
/// Takes it back, where the store ends before the state does.
template <FeatureSet F, class M>
PL_HD inline void drop_store(PathState<F, M>& state) {
    if constexpr (kNeedsStore<M>) state.memory = {};
}

/// A light sample that contributes if nothing occludes it.
template <class M>
struct ShadowRequest {
    Ray ray;
    Vec3f contribution{0.0f};
    bool wanted = false;  ///< the light sample contributes if the ray is not occluded
    [[no_unique_address]] typename M::Light light{};
};

enum class PathStatus : std::uint32_t { Continues, Finished };

/// Counts of events: integers, so that their sum does not depend on order.
template <class Count>
struct PathCountersOf {
    Count segments = 0;  ///< path rays traced, without shadow rays
    Count shadow_rays = 0;
    Count emission_rays = 0;    ///< further camera rays for emission alone, see camera_emission.h
    Count escaped = 0;          ///< paths that left the scene
    Count truncated = 0;        ///< paths cut at max_depth
    Count zero_directions = 0;  ///< sampled directions with f cos = 0
    MethodCountersOf<Count> method;
};
using PathCounters = PathCountersOf<std::uint64_t>;

/// Counts of one pass. Equal for every thread count and launch shape.
template <class Count>
struct PassCountersOf {
    PathCountersOf<Count> path;
    Count paths = 0;  ///< finished: pixels of a picture pass, probes of a precomputation
    Count zero_contribution_paths = 0;
    Count invalid_samples = 0;
    VarianceSums variance;  ///< of the samples measured, see VarianceMeasure
};
using PassCounters = PassCountersOf<std::uint64_t>;

/// Calls add(total, count) for every counter of events: the one list of them.
template <class Total, class Count, class Add>
PL_HD inline void add_counters(PassCountersOf<Total>& totals, const PassCountersOf<Count>& counts, Add&& add) {
    add(totals.path.segments, counts.path.segments);
    add(totals.path.shadow_rays, counts.path.shadow_rays);
    add(totals.path.emission_rays, counts.path.emission_rays);
    add(totals.path.escaped, counts.path.escaped);
    add(totals.path.truncated, counts.path.truncated);
    add(totals.path.zero_directions, counts.path.zero_directions);
    add(totals.path.method.records, counts.path.method.records);
    add(totals.path.method.clamped_records, counts.path.method.clamped_records);
    add(totals.path.method.lookups, counts.path.method.lookups);
    add(totals.path.method.lookup_misses, counts.path.method.lookup_misses);
    add(totals.path.method.cut_returns, counts.path.method.cut_returns);
    add(totals.paths, counts.paths);
    add(totals.zero_contribution_paths, counts.zero_contribution_paths);
    add(totals.invalid_samples, counts.invalid_samples);
}

inline PassCounters& operator+=(PassCounters& totals, const PassCounters& counts) {
    const auto add = [](std::uint64_t& total, std::uint64_t count) { total += count; };
    add_counters(totals, counts, add);
    VarianceSums::each(totals.variance, counts.variance, add);
    return totals;
}

/// Counts a finished path by its radiance.
PL_HD inline void count_path(PassCounters& counters, Vec3f radiance, bool valid) {
    ++counters.paths;
    counters.zero_contribution_paths += is_black(radiance) ? 1u : 0u;
    counters.invalid_samples += valid ? 0u : 1u;
}

}  // namespace pl
