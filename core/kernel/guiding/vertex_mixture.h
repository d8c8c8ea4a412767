// From the outputs of a network to the mixture that a vertex is guided by.
#pragma once

#include "core/kernel/guiding/lobe_mixture.h"
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
PL_INLINE Vec3f vertex_axis(const float* outputs, Vec3f normal, std::uint32_t lobe) {
    const auto component = [&](std::uint32_t parameter, std::uint32_t bit) {
        return outputs[parameter * kVertexLobes + lobe] + ((lobe >> bit & 1u) != 0 ? kFirstSpread : -kFirstSpread);
    };
    return {normal.x + component(kLobeX, 0), normal.y + component(kLobeY, 1), normal.z + component(kLobeZ, 2)};
}

/// A lobe of incident radiance in the world's frame.
PL_INLINE VmfLobe vertex_lobe(const float* outputs, Vec3f normal, std::uint32_t lobe) {
    const Vec3f axis = vertex_axis(outputs, normal, lobe);
    const float length = glm::length(axis);
    const bool is_lost = !(length > 1.0e-6f);
    const float inverse = 1.0f / (is_lost ? 1.0f : length);
    const float narrowness = kFirstNarrowness + outputs[kLobeNarrowness * kVertexLobes + lobe];
    return {{is_lost ? normal.x : axis.x * inverse, is_lost ? normal.y : axis.y * inverse,
             is_lost ? normal.z : axis.z * inverse},
            exp_of(clamp_to(narrowness, kLeastNarrowness, kMostNarrowness))};
}

/// The mixture of the outputs times the cosine to the normal.
PL_HD inline VertexMixture vertex_mixture(const float* outputs, Vec3f normal) {
    const float* logits = outputs + kLobeLogit * kVertexLobes;
    float most = logits[0];
    for (std::uint32_t i = 1; i < kVertexLobes; ++i) most = max_of(most, logits[i]);
    LobesOf<kVertexLobes> lobes;
    lobes.used = kVertexLobes;
    for (std::uint32_t i = 0; i < kVertexLobes; ++i)
        lobes.set(i, vertex_lobe(outputs, normal, i), decay_of(most - logits[i]));
    return times_cosine(lobes, normal);
}

/// The cosine alone, by the lobe that stands for it.
PL_HD inline VertexMixture cosine_mixture(Vec3f normal) {
    LobesOf<kVertexLobes> lobes;
    lobes.used = 1;
    for (std::uint32_t i = 0; i < lobes.count(); ++i) lobes.set(i, {normal, 0.0f}, i == 0 ? 1.0f : 0.0f);
    return times_cosine(lobes, normal);
}

}  // namespace pl
