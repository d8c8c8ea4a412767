// Russian roulette: whether a path continues from a vertex, by its contribution estimate.
#pragma once

#include "core/kernel/integrator/medium.h"

namespace pl {

/// Roulette never ends more than 9 of 10 paths at once, which bounds its weight.
inline constexpr float kMinSurvival = 0.1f;

/// Most specular vertices that are left out of the count of vertices before roulette: mirrors that face one another end paths, too.
inline constexpr std::uint32_t kMostSpecularBeforeRoulette = 8;

/// The vertices so far that count for PathSettings::roulette_start. Specular ones do not: behind glass or in a mirror the first
/// surface that absorbs is the one that a pixel shows, however dark it is.
template <FeatureSet F, class M>
PL_HD inline std::uint32_t counted_vertices(const PathState<F, M>& state) {
    if constexpr (F.has_any(kLobeFeatures)) return state.vertices - state.specular_vertices;
    return state.vertices;
}

/// Counts the last vertex of `state`, which is specular, until the path first plays roulette.
template <FeatureSet F, class M>
PL_HD inline void count_specular(const PathSettings& settings, PathState<F, M>& state) {
    const bool has_played = counted_vertices(state) > settings.roulette_start;
    if (!has_played && state.specular_vertices < kMostSpecularBeforeRoulette) ++state.specular_vertices;
}

/// Survival probability for a contribution estimate. Estimates by a field may be wrong, most of all early: they can keep a path but
/// not end it sooner than the albedos alone would, so weights grow no faster than reflection reduces them, and their variance stays
/// finite.
template <class N>
PL_INLINE typename N::Real survival_probability(const PathSettings& settings, const typename N::Real& estimate,
                                                const typename N::Real& survival) {
    typename N::Real wanted = survival;
    if (settings.roulette != RouletteRule::Albedo) {
        wanted = estimate / settings.roulette_threshold;
        wanted = select(static_cast<typename N::Mask>(wanted < survival), survival, wanted);
    }
    return clamp_real<N>(wanted, kMinSurvival, 1.0f);
}
PL_HD inline float survival_probability(const PathSettings& settings, float estimate, float survival) {
    return survival_probability<One>(settings, estimate, survival);
}

/// A round of Russian roulette, for one path or for a vector of them.
template <class N>
struct RouletteRound {
    typename N::Mask ends;      ///< the path ends here
    typename N::Real weight;    ///< of a path that goes on: 1 / survival probability
    typename N::Real survival;  ///< PathState::survival afterwards
};
/// `survival`: PathState::survival, the last vertex included; u in [0, 1).
template <class N>
PL_INLINE RouletteRound<N> play_roulette(const PathSettings& settings, const typename N::Real& estimate,
                                         const typename N::Real& survival, const typename N::Real& u) {
    const auto probability = survival_probability<N>(settings, estimate, survival);
    return {u >= probability, 1.0f / probability, min_real<N>(survival / probability, 1.0f)};
}

/// Plays Russian roulette with a path that has a small contribution estimate. Returns the weight of a path that goes on, 1 / survival
/// probability, which its throughput then includes; 0 if the path ends.
/// [after Vorba and Krivanek 2016, "Adjoint-Driven Russian Roulette and Splitting in Light Transport Simulation"]
template <FeatureSet F, Method M>
PL_HD inline float play_roulette(const M& method, const PathSettings& settings, const typename M::Vertex& vertex,
                                 Vec3f albedo, float u, PathState<F, M>& state) {
    state.survival *= max_component(albedo);
    const float estimate =
        method.estimate_contribution(vertex, albedo, state.throughput, state.survival, state.expectation);
    if (counted_vertices(state) < settings.roulette_start) return 1.0f;
    const RouletteRound<One> round = play_roulette<One>(settings, estimate, state.survival, u);
    if (round.ends) return 0.0f;
    state.throughput *= round.weight;
    state.survival = round.survival;
    return round.weight;
}

}  // namespace pl
