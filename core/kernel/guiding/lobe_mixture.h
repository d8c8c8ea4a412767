// Mixtures of von Mises-Fisher lobes by components: product with the cosine, sampling and density. Loops over lobes have no branches, so
// that compilers make vectors of them.
#pragma once

#include "core/kernel/base/frame.h"
#include "core/kernel/guiding/vmf_lobe.h"

namespace pl {

/// Concentration of the lobe that stands for the clamped cosine in products.   [Herholz et al. 2019; OpenPGL]
inline constexpr float kCosineKappa = 2.18853f;

/// The sum of all values, in an order that vectors keep.
template <std::uint32_t kCount>
PL_INLINE float sum_by_halves(const float (&values)[kCount]) {
    static_assert((kCount & (kCount - 1)) == 0);
    float sums[kCount];
    for (std::uint32_t i = 0; i < kCount; ++i) sums[i] = values[i];
    for (std::uint32_t half = kCount / 2; half > 0; half /= 2)
        for (std::uint32_t i = 0; i < half; ++i) sums[i] += sums[i + half];
    return sums[0];
}

/// Lobes are computed in blocks of so many, up to the last one with a weight; those that fill up its block have the weight 0.
inline constexpr std::uint32_t kLobeBlock = 4;

/// Lobes in the frame of a volume's normal or of the world. kLeast: so many are computed, however few have a weight.
template <std::uint32_t kCapacity, std::uint32_t kLeast = 0>
struct LobesOf {
    static_assert(kCapacity % kLobeBlock == 0);

    /// Uninitialized: vertices are copied before their mixture is set, and those that no volume serves never have one.
    PL_HD LobesOf() {}

    std::uint32_t used = 0;                          ///< those with a weight are among the first
    float x[kCapacity], y[kCapacity], z[kCapacity];  ///< of the unit means
    float kappa[kCapacity];
    float weight[kCapacity];

    /// Number of lobes that loops compute: whole blocks.
    PL_INLINE std::uint32_t count() const {
        if constexpr (kLeast == kCapacity) return kCapacity;
        return max_of(kLeast, (used + (kLobeBlock - 1)) / kLobeBlock * kLobeBlock);
    }

    PL_INLINE void set(std::uint32_t i, const VmfLobe& lobe, float lobe_weight) {
        x[i] = lobe.mean.x;
        y[i] = lobe.mean.y;
        z[i] = lobe.mean.z;
        kappa[i] = lobe.kappa;
        weight[i] = lobe_weight;
    }
    PL_INLINE VmfLobe lobe(std::uint32_t i) const { return {{x[i], y[i], z[i]}, kappa[i]}; }
};

/// Lobes times the cosine to a normal, which a lobe stands for: a normalized mixture, once all lobes are set.
template <std::uint32_t kCapacity, std::uint32_t kLeast = 0>
struct LobeMixtureOf {
    PL_HD LobeMixtureOf() {}

    LobesOf<kCapacity, kLeast> lobes;  ///< their weights are their probabilities
    float peak[kCapacity];             ///< probability times the lobe's density at its mean

    /// Sets the product of a lobe and the cosine. The lobes of whole blocks have to be set, see LobesOf::count().
    PL_INLINE void set(std::uint32_t i, const VmfLobe& lobe, float lobe_weight, Vec3f normal) {
        const VmfProduct product = vmf_product(lobe, {normal, kCosineKappa});
        peak[i] = lobe_weight * vmf_peak(lobe.kappa) * product.scale;
        lobes.set(i, product.lobe, peak[i] / vmf_peak(product.lobe.kappa));
    }
    /// When the lobes are set, of which some have a positive weight.
    PL_INLINE void normalize() {
        for (std::uint32_t i = lobes.count(); i < kCapacity; ++i) lobes.weight[i] = 0.0f;
        const float sum = sum_by_halves(lobes.weight);
        for (std::uint32_t i = 0; i < lobes.count(); ++i) {
            lobes.weight[i] /= sum;
            peak[i] /= sum;
        }
    }

    PL_HD float pdf_sa(Vec3f wi) const {
        float densities[kCapacity] = {};
        for (std::uint32_t i = 0; i < lobes.count(); ++i) {
            const VmfLobe lobe = lobes.lobe(i);
            densities[i] = peak[i] * vmf_falloff(lobe.mean, lobe.kappa, wi);
        }
        return sum_by_halves(densities);
    }
    /// u in [0,1)^2; its first coordinate chooses the lobe, and its rest, uniform again, goes on.
    PL_HD Vec3f sample(Vec2f u) const {
        std::uint32_t chosen = 0;
        float below = 0.0f, sum = 0.0f;
        for (std::uint32_t i = 0; i < lobes.used; ++i) {
            if (!(lobes.weight[i] > 0.0f)) continue;
            if (u.x >= sum) {
                chosen = i;
                below = sum;
            }
            sum += lobes.weight[i];
        }
        const VmfLobe lobe = lobes.lobe(chosen);
        const float rest = (u.x - below) / lobes.weight[chosen];
        const Vec3f local = sample_vmf_local(lobe.kappa, {clamp_to(rest, 0.0f, kBelowOne), u.y});
        return make_frame(lobe.mean).to_world(local);
    }
};

/// The mixture of lobes of which some have a positive weight.
template <std::uint32_t kCapacity>
PL_HD inline LobeMixtureOf<kCapacity> times_cosine(const LobesOf<kCapacity>& lobes, Vec3f normal) {
    LobeMixtureOf<kCapacity> mixture;
    mixture.lobes.used = lobes.used;
    for (std::uint32_t i = 0; i < lobes.count(); ++i) mixture.set(i, lobes.lobe(i), lobes.weight[i], normal);
    mixture.normalize();
    return mixture;
}

}  // namespace pl
