// Russian roulette and splitting: how many paths go on from a vertex, by what they are still worth.
#pragma once

#include "core/kernel/integrator/path.h"

namespace pl {

/// Roulette never ends more than 9 of 10 paths at once, which bounds its weight.
inline constexpr float kMinSurvival = 0.1f;

/// Chance of going on. An opinion may be wrong, and most are at first, so by RouletteRule::Spare it can spare a path but not
/// end it sooner than the reflectances alone would: weights then grow no faster than they fall by reflection, and their
/// variance stays finite. RouletteRule::Field trusts the opinion.
PL_HD inline float survival_probability(const PathSettings& settings, float worth, float survival) {
    float wanted = survival;
    if (settings.roulette == RouletteRule::Spare) wanted = max_of(worth / settings.roulette_threshold, survival);
    if (settings.roulette == RouletteRule::Field) wanted = worth / settings.roulette_threshold;
    return clamp_to(wanted, kMinSurvival, 1.0f);
}

/// What a path does at a vertex.
struct Continuation {
    std::uint32_t branches = 0;  ///< that go on from there; none: it ends
    float weight = 1.0f;         ///< of what one of them brings, as an estimate of what the vertex reflects
};

/// As many branches as the path is worth, on the mean, each with its share of the throughput. `u` decides about the last one.
template <FeatureSet F, class M>
PL_HD inline Continuation split(const PathSettings& settings, float worth, float u, PathState<F, M>& state) {
    const float wanted = min_of(worth / settings.split_threshold, static_cast<float>(state.branches.room()));
    const auto sure = static_cast<std::uint32_t>(wanted);
    state.throughput *= 1.0f / wanted;
    return {.branches = u < wanted - static_cast<float>(sure) ? sure + 1u : sure};
}

/// Asks the method what the path is still worth; splits it if that is much, and plays Russian roulette if it is little.
/// [Vorba and Krivanek 2016, "Adjoint-Driven Russian Roulette and Splitting in Light Transport Simulation"]
template <FeatureSet F, Method M>
PL_HD inline Continuation play_roulette(const M& method, const PathSettings& settings,
                                        const typename M::Vertex& vertex, Vec3f albedo, float u,
                                        PathState<F, M>& state) {
    state.survival *= max_component(albedo);
    const float worth = method.roulette_worth(vertex, albedo, state.throughput, state.survival, state.expectation);
    if (state.vertices < settings.roulette_start) return {.branches = 1};
    if constexpr (SplittingMethod<M>) {
        if (worth > settings.split_threshold && state.branches.room() > 1) return split(settings, worth, u, state);
    }
    const float probability = survival_probability(settings, worth, state.survival);
    if (u >= probability) return {};
    state.throughput *= 1.0f / probability;
    state.survival = min_of(state.survival / probability, 1.0f);
    return {.branches = 1, .weight = 1.0f / probability};
}

}  // namespace pl
