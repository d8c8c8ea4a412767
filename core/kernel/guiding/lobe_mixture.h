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

/// Lobes are computed by so many; those that fill the last of these blocks have no weight.
inline constexpr std::uint32_t kLobeBlock = 4;

/// Lobes in the frame of a volume's normal or of the world.
template <std::uint32_t kCapacity>
struct LobesOf {
    static_assert(kCapacity % kLobeBlock == 0);

    std::uint32_t used = 0;                          ///< those with a weight are among the first
    float x[kCapacity], y[kCapacity], z[kCapacity];  ///< of the unit means
    float kappa[kCapacity];
    float weight[kCapacity];

    /// Those to be computed: whole blocks.
    PL_INLINE std::uint32_t count() const { return (used + (kLobeBlock - 1)) / kLobeBlock * kLobeBlock; }

    PL_INLINE void set(std::uint32_t i, const VmfLobe& lobe, float lobe_weight) {
        x[i] = lobe.mean.x;
        y[i] = lobe.mean.y;
        z[i] = lobe.mean.z;
        kappa[i] = lobe.kappa;
        weight[i] = lobe_weight;
    }
    PL_INLINE VmfLobe lobe(std::uint32_t i) const { return {{x[i], y[i], z[i]}, kappa[i]}; }
};

/// A normalized mixture.
template <std::uint32_t kCapacity>
struct LobeMixtureOf {
    LobesOf<kCapacity> lobes;  ///< their weights are their probabilities
    float peak[kCapacity];     ///< probability times the lobe's density at its mean

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

/// Lobes times the cosine to a normal, which a lobe stands for: a mixture again. A weight is positive.
template <std::uint32_t kCapacity>
PL_HD inline LobeMixtureOf<kCapacity> times_cosine(const LobesOf<kCapacity>& lobes, Vec3f normal) {
    LobeMixtureOf<kCapacity> mixture{};
    mixture.lobes.used = lobes.used;
    for (std::uint32_t i = 0; i < lobes.count(); ++i) {
        const VmfLobe lobe = lobes.lobe(i);
        const VmfProduct product = vmf_product(lobe, {normal, kCosineKappa});
        mixture.peak[i] = lobes.weight[i] * vmf_peak(lobe.kappa) * product.scale;
        mixture.lobes.set(i, product.lobe, mixture.peak[i] / vmf_peak(product.lobe.kappa));
    }
    const float sum = sum_by_halves(mixture.lobes.weight);
    for (std::uint32_t i = 0; i < lobes.count(); ++i) {
        mixture.lobes.weight[i] /= sum;
        mixture.peak[i] /= sum;
    }
    return mixture;
}

}  // namespace pl
