// Mixtures of von Mises-Fisher lobes as kernels read them: the mixture as a point sees it, its product with the cosine, sampling and
// density.   [Ruppert, Herholz and Lensch 2020, "Robust Fitting of Parallax-Aware Mixtures for Path Guiding"]
#pragma once

#include "core/kernel/guiding/lobe_arrays.h"
#include "core/kernel/guiding/table_view.h"
#include "core/kernel/guiding/vmf_lobe.h"

namespace pl {

/// Concentration of the lobe that stands for the clamped cosine in products.   [Herholz et al. 2019; OpenPGL]
inline constexpr float kCosineKappa = 2.18853f;
/// Largest shift of a mean by parallax, in units of the distance to its light: beyond it lobes would turn around.
inline constexpr float kMostShift = 0.9f;

/// A mixture of at most kCapacity lobes, in the frame of a volume's normal or of the world.
template <std::uint32_t kCapacity>
struct LobeMixtureOf {
    std::uint32_t count = 0;
    VmfLobe lobes[kCapacity];
    float share[kCapacity];  ///< probability of the lobe
    float peak[kCapacity];   ///< share times the lobe's density at its mean

    /// Adds a lobe of this weight times the cosine to a normal, which a lobe stands for.
    PL_HD void add_times_cosine(const VmfLobe& lobe, float weight, Vec3f normal) {
        const VmfProduct product = vmf_product(lobe, {normal, kCosineKappa});
        lobes[count] = product.lobe;
        peak[count] = weight * vmf_peak(lobe.kappa) * product.scale;
        share[count] = peak[count] / vmf_peak(product.lobe.kappa);
        ++count;
    }
    /// Divides by the sum of all shares.
    PL_HD void normalize() {
        float sum = 0.0f;
        for (std::uint32_t i = 0; i < count; ++i) sum += share[i];
        for (std::uint32_t i = 0; i < count; ++i) {
            share[i] /= sum;
            peak[i] /= sum;
        }
    }

    PL_HD float pdf_sa(Vec3f wi) const {
        float sum = 0.0f;
        for (std::uint32_t i = 0; i < count; ++i) sum += peak[i] * vmf_falloff(lobes[i].mean, lobes[i].kappa, wi);
        return sum;
    }
    /// u in [0,1)^2; its first coordinate chooses the lobe, and its rest, uniform again, goes on.
    PL_HD Vec3f sample(Vec2f u) const {
        std::uint32_t chosen = 0;
        float below = 0.0f;
        while (chosen + 1 < count && u.x >= below + share[chosen]) below += share[chosen++];
        const float rest = share[chosen] > 0.0f ? (u.x - below) / share[chosen] : 0.0f;
        const VmfLobe& lobe = lobes[chosen];
        const Vec3f local = sample_vmf_local(lobe.kappa, {clamp_to(rest, 0.0f, kBelowOne), u.y});
        return make_frame(lobe.mean).to_world(local);
    }
};
using LobeMixture = LobeMixtureOf<kMostLobes>;

/// A unit direction in 30 bits, octahedral: to 1e-4.   [Cigolle et al. 2014, "A Survey of Efficient Representations for Independent
/// Unit Vectors"]
inline constexpr float kDirectionSteps = 32767.0f;
PL_HD inline Vec2f fold_octahedron(Vec2f p) {
    return {(1.0f - std::fabs(p.y)) * std::copysign(1.0f, p.x), (1.0f - std::fabs(p.x)) * std::copysign(1.0f, p.y)};
}
PL_HD inline std::int32_t pack_direction(Vec3f v) {
    const float norm = std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z);
    Vec2f p = Vec2f{v.x, v.y} / norm;
    if (v.z < 0.0f) p = fold_octahedron(p);
    const auto steps = [](float x) {
        return static_cast<std::int32_t>(clamp_to(0.5f * x + 0.5f, 0.0f, 1.0f) * kDirectionSteps + 0.5f);
    };
    return steps(p.x) << 15 | steps(p.y);
}
PL_HD inline Vec3f unpack_direction(std::int32_t bits) {
    const auto value = [](std::int32_t steps) { return static_cast<float>(steps) * (2.0f / kDirectionSteps) - 1.0f; };
    Vec2f p{value(bits >> 15 & 0x7fff), value(bits & 0x7fff)};
    const float z = 1.0f - std::fabs(p.x) - std::fabs(p.y);
    if (z < 0.0f) p = fold_octahedron(p);
    return glm::normalize(Vec3f{p.x, p.y, z});
}

struct LobeView : PlacementView, LobeArrays<ConstSpan, Span> {
    DirectionCells cells;              ///< of the hemispheres that are shown
    std::uint32_t light_clusters = 0;  ///< of the scene's light tree; 0: no tree
    float radiance_unit = 1.0f;        ///< of the fixed-point sums: a power of two not below the brightest emission
    Writers writers = Writers::Many;   ///< threads that add to the pending sums

    /// A lobe of a volume as its site sees it.
    PL_HD VmfLobe lobe_of(std::uint32_t volume, std::uint32_t i) const {
        const std::uint32_t lobe = volume * kMostLobes + i;
        return {{mean[3 * lobe], mean[3 * lobe + 1], mean[3 * lobe + 2]}, kappa[lobe]};
    }
    /// As a point at `offset` from the site sees it: its mean turns towards the point that it has from the site, at the lobe's mean
    /// distance; its width stays. `offset` in units of the extent, in the frame of the normal.
    PL_HD VmfLobe lobe_at(std::uint32_t volume, std::uint32_t i, Vec3f offset) const {
        VmfLobe lobe = lobe_of(volume, i);
        const Vec3f shift = offset * inverse_distance[volume * kMostLobes + i];
        const float length = glm::length(shift);
        if (!(length > 0.0f)) return lobe;
        lobe.mean = glm::normalize(lobe.mean - shift * (min_of(length, kMostShift) / length));
        return lobe;
    }
    PL_HD float weight_of(std::uint32_t volume, std::uint32_t i) const { return weight[volume * kMostLobes + i]; }

    /// Density in proportion to incident radiance at a point, per steradian.
    PL_HD float radiance_pdf_sa(std::uint32_t volume, Vec3f offset, Vec3f wi) const {
        float sum = 0.0f;
        for (std::uint32_t i = 0; i < lobe_count[volume]; ++i) {
            const VmfLobe lobe = lobe_at(volume, i, offset);
            sum += weight_of(volume, i) * vmf_peak(lobe.kappa) * vmf_falloff(lobe.mean, lobe.kappa, wi);
        }
        return sum;
    }
    /// The mixture at a point times the cosine to its normal, which a lobe stands for, normalized: a mixture again.
    PL_HD LobeMixture product_at(std::uint32_t volume, Vec3f offset, Vec3f normal) const {
        LobeMixture mixture;
        for (std::uint32_t i = 0; i < lobe_count[volume]; ++i)
            mixture.add_times_cosine(lobe_at(volume, i, offset), weight_of(volume, i), normal);
        mixture.normalize();
        return mixture;
    }

    /// A position relative to the site of a volume, in units of the extent, in the frame of its normal; 0 without an extent.
    PL_HD Vec3f offset_of(std::int32_t volume, Vec3f position) const {
        if (!(extent > 0.0f)) return Vec3f{0.0f};
        const Vec3f difference = position - sites[static_cast<std::uint32_t>(volume)].position;
        return frame(volume).to_local(difference / extent);
    }
};

}  // namespace pl
