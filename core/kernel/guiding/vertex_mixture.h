// From the outputs of a network to the mixture that a vertex is guided by.
#pragma once

#include "core/kernel/guiding/lobe_view.h"
#include "core/kernel/guiding/vertex_network.h"

namespace pl {

using VertexMixture = LobeMixtureOf<kVertexLobes>;

/// Logarithms of concentrations: of an untrained network, and bounds. The widest lobe is uniform; the narrowest has the solid angle of
/// one of 256 cells, of which its teacher knows no more than their mean.
inline constexpr float kFirstNarrowness = 1.6f;
inline constexpr float kLeastNarrowness = -4.0f;
inline constexpr float kMostNarrowness = 7.0f;

/// Means of an untrained network: the normal and this far towards a corner of a cube, so that the lobes spread over the hemisphere.
inline constexpr float kFirstSpread = 0.5f;

/// The vector whose direction is the mean of a lobe.
PL_HD inline Vec3f vertex_axis(const float* outputs, Vec3f normal, std::uint32_t lobe) {
    const auto component = [&](std::uint32_t parameter, std::uint32_t bit) {
        return outputs[parameter * kVertexLobes + lobe] + ((lobe >> bit & 1u) != 0 ? kFirstSpread : -kFirstSpread);
    };
    return normal + Vec3f{component(kLobeX, 0), component(kLobeY, 1), component(kLobeZ, 2)};
}

/// A lobe of incident radiance in the world's frame.
PL_HD inline VmfLobe vertex_lobe(const float* outputs, Vec3f normal, std::uint32_t lobe) {
    const Vec3f axis = vertex_axis(outputs, normal, lobe);
    const float length = glm::length(axis);
    const float narrowness = kFirstNarrowness + outputs[kLobeNarrowness * kVertexLobes + lobe];
    return {length > 1.0e-6f ? axis / length : normal,
            exp_of(clamp_to(narrowness, kLeastNarrowness, kMostNarrowness))};
}

/// The mixture of the outputs times the cosine to the normal.
PL_HD inline VertexMixture vertex_mixture(const float* outputs, Vec3f normal) {
    const float* logits = outputs + kLobeLogit * kVertexLobes;
    float most = logits[0];
    for (std::uint32_t i = 1; i < kVertexLobes; ++i) most = max_of(most, logits[i]);
    VertexMixture mixture;
    for (std::uint32_t i = 0; i < kVertexLobes; ++i)
        mixture.add_times_cosine(vertex_lobe(outputs, normal, i), decay_of(most - logits[i]), normal);
    mixture.normalize();
    return mixture;
}

/// The cosine alone, by the lobe that stands for it.
PL_HD inline VertexMixture cosine_mixture(Vec3f normal) {
    VertexMixture mixture;
    mixture.add_times_cosine({normal, 0.0f}, 1.0f, normal);
    mixture.normalize();
    return mixture;
}

}  // namespace pl
