// From the outputs of a network to the mixture that a vertex is guided by.
#pragma once

#include "core/kernel/guiding/lobe_mixture.h"
#include "core/kernel/guiding/vertex_network.h"

namespace pl {

using VertexMixture = LobeMixtureOf<kVertexLobes, kVertexLobes>;

/// Logarithms of concentrations: of an untrained network, and bounds. The widest lobe is uniform; the narrowest has the solid angle of
/// one of 256 cells, of which its teacher knows no more than their mean.
inline constexpr float kFirstNarrowness = 1.6f;
inline constexpr float kLeastNarrowness = -4.0f;
inline constexpr float kMostNarrowness = 7.0f;

/// Means of an untrained network: the normal and this far towards a corner of a cube, so that the lobes spread over the hemisphere.
inline constexpr float kFirstSpread = 0.5f;

/// The outputs for one lobe.
struct LobeOutputs {
    float logit;
    Vec3f shift;  ///< of the vector whose direction is the mean
    float narrowness;
};
/// value(number): an output of the network.
template <class Value>
PL_INLINE LobeOutputs outputs_by(const Value& value, std::uint32_t lobe) {
    const auto output = [&](std::uint32_t parameter) { return value(parameter * kVertexLobes + lobe); };
    return {output(kLobeLogit), {output(kLobeX), output(kLobeY), output(kLobeZ)}, output(kLobeNarrowness)};
}
PL_INLINE LobeOutputs outputs_of(const float* outputs, std::uint32_t lobe) {
    return outputs_by([=](std::uint32_t number) { return outputs[number]; }, lobe);
}

/// The vector whose direction is the mean of a lobe.
PL_INLINE Vec3f vertex_axis(Vec3f shift, Vec3f normal, std::uint32_t lobe) {
    const auto spread = [&](std::uint32_t bit) { return (lobe >> bit & 1u) != 0 ? kFirstSpread : -kFirstSpread; };
    return {normal.x + (shift.x + spread(0)), normal.y + (shift.y + spread(1)), normal.z + (shift.z + spread(2))};
}

/// A lobe of incident radiance in the world's frame.
PL_INLINE VmfLobe vertex_lobe(const LobeOutputs& outputs, Vec3f normal, std::uint32_t lobe) {
    const Vec3f axis = vertex_axis(outputs.shift, normal, lobe);
    const float length = glm::length(axis);
    const bool is_lost = !(length > 1.0e-6f);
    const float inverse = 1.0f / (is_lost ? 1.0f : length);
    const float narrowness = kFirstNarrowness + outputs.narrowness;
    return {{is_lost ? normal.x : axis.x * inverse, is_lost ? normal.y : axis.y * inverse,
             is_lost ? normal.z : axis.z * inverse},
            exp_of(clamp_to(narrowness, kLeastNarrowness, kMostNarrowness))};
}

/// Sets the mixture of outputs times the cosine to the normal. outputs(lobe): its LobeOutputs, which may lie at its place in the
/// mixture.
template <class Outputs>
PL_HD void set_mixture_by(VertexMixture& mixture, const Outputs& outputs, Vec3f normal) {
    float most = outputs(0).logit;
    for (std::uint32_t i = 1; i < kVertexLobes; ++i) most = max_of(most, outputs(i).logit);
    mixture.lobes.used = kVertexLobes;
    // Two loops: compilers make vectors of both, but not of one.
    LobesOf<kVertexLobes, kVertexLobes>& lobes = mixture.lobes;
    for (std::uint32_t i = 0; i < kVertexLobes; ++i) {
        const LobeOutputs of_lobe = outputs(i);
        lobes.set(i, vertex_lobe(of_lobe, normal, i), decay_of(most - of_lobe.logit));
    }
    for (std::uint32_t i = 0; i < kVertexLobes; ++i) mixture.set(i, lobes.lobe(i), lobes.weight[i], normal);
    mixture.normalize();
}
/// outputs: [kVertexColumns].
PL_HD inline void set_mixture(VertexMixture& mixture, const float* outputs, Vec3f normal) {
    set_mixture_by(
        mixture, [=](std::uint32_t lobe) { return outputs_of(outputs, lobe); }, normal);
}

/// Sets the mixture of the cosine alone, by the lobe that stands for it.
PL_HD inline void set_cosine(VertexMixture& mixture, Vec3f normal) {
    mixture.lobes.used = 1;
    for (std::uint32_t i = 0; i < kVertexLobes; ++i) mixture.set(i, {normal, 0.0f}, i == 0 ? 1.0f : 0.0f, normal);
    mixture.normalize();
}

}  // namespace pl
