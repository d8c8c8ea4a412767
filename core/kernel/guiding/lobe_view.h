// Mixtures of von Mises-Fisher lobes: their arrays, and how kernels read them: the mixture as a point sees it, its product with the cosine, and density.
// [Ruppert, Herholz and Lensch 2020, "Robust Fitting of Parallax-Aware Mixtures for Path Guiding"]
#pragma once

#include "core/kernel/guiding/field_view.h"
#include "core/kernel/guiding/lobe_mixture.h"

namespace pl {

/// Number of lobes of a mixture at most, and at first. Ruppert et al. 2020 have 32 and 16 lobes over the sphere; a volume serves the
/// hemisphere of one normal, which takes half as many.
inline constexpr std::uint32_t kMostLobes = 16;
inline constexpr std::uint32_t kFirstLobes = 8;

/// Statistics of a lobe: means over training samples of responsibility times a quantity, the first of them times the weight
/// w = target / density. Directions are seen from the volume's site, in the frame of its normal.
enum LobeMoment : std::uint32_t {
    kMomentWeight,  ///< w: radiance times steradians
    kMomentX,       ///< w times direction
    kMomentY,
    kMomentZ,
    kMomentInverse,  ///< w / distance from the site, in units of 1 / extent
    kMomentXx,       ///< w times products of the direction's components; z z follows from the weight
    kMomentXy,
    kMomentXz,
    kMomentYy,
    kMomentYz,
    kMomentSquare,  ///< (w / its mean)^2: how few samples bring the light
    kMomentMisfit,  ///< f^2 / (density mixture), f the normalized target: chi-square of Pearson
    kLobeMoments
};

/// One mixture per radiance volume, and the volume's irradiance. A lobe is numbered volume * kMostLobes + i.
template <template <class> class Learned, template <class> class Pending>
struct LobeArrays : MixtureSums<Learned, Pending>,
                    VolumeIrradiance<Learned, Pending>,
                    LightSampleSums<Learned, Pending> {
    Learned<std::uint32_t> lobe_count;  ///< of the volume, 1 to kMostLobes. [volume]
    Learned<float> weight;              ///< share of the lobe in its mixture; 0: not in use. [lobe]
    Learned<float> mean;                ///< unit direction in the frame of the volume's normal. [lobe][3]
    Learned<float> kappa;               ///< concentration. [lobe]
    Learned<float> inverse_distance;    ///< from the site to the lobe's light, in units of 1 / extent. [lobe]
    Learned<float> moments;             ///< statistics so far. [lobe][LobeMoment]
    Learned<std::uint32_t> age;         ///< updates since the lobe was split or merged. [lobe]
    Learned<float> total;  ///< integral of learned radiance over directions; 0: nothing is known. [volume]
    Pending<std::int64_t> pending_moments;  ///< sums of new training samples, fixed point. [lobe][LobeMoment]
};

/// Largest shift of a mean by parallax, in units of the distance to its light: beyond it lobes would turn around.
inline constexpr float kMostShift = 0.9f;

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

struct LobeView : FieldView, LobeArrays<ConstSpan, Span> {
    /// A lobe of a volume as its site sees it.
    PL_HD VmfLobe lobe_of(std::uint32_t volume, std::uint32_t i) const {
        const std::uint32_t lobe = volume * kMostLobes + i;
        return {{mean[3 * lobe], mean[3 * lobe + 1], mean[3 * lobe + 2]}, kappa[lobe]};
    }
    PL_HD float weight_of(std::uint32_t volume, std::uint32_t i) const { return weight[volume * kMostLobes + i]; }
    /// The lobes of a volume as a point at `offset` from the site sees them: a mean turns towards the point that it has from the site, at
    /// the lobe's mean distance; its width stays. `offset` in units of the extent, in the frame of the normal.
    PL_HD LobesOf<kMostLobes> lobes_at(std::uint32_t volume, Vec3f offset) const {
        constexpr float kNoLength = 1.0e-20f;
        const float distance = glm::length(offset);
        LobesOf<kMostLobes> lobes;
        lobes.used = lobe_count[volume];
        for (std::uint32_t i = 0; i < lobes.count(); ++i) {
            const VmfLobe lobe = lobe_of(volume, i);
            const float inverse = inverse_distance[volume * kMostLobes + i];
            const float length = distance * inverse;
            const float share = inverse * (min_of(length, kMostShift) / max_of(length, kNoLength));
            const Vec3f turned = lobe.mean - offset * share;
            const float scale = 1.0f / max_of(glm::length(turned), kNoLength);
            lobes.set(i, {{turned.x * scale, turned.y * scale, turned.z * scale}, lobe.kappa}, weight_of(volume, i));
        }
        return lobes;
    }

    /// Density in proportion to incident radiance at a point, per steradian.
    PL_HD float radiance_pdf_sa(std::uint32_t volume, Vec3f offset, Vec3f wi) const {
        const LobesOf<kMostLobes> lobes = lobes_at(volume, offset);
        float densities[kMostLobes] = {};
        for (std::uint32_t i = 0; i < lobes.count(); ++i) {
            const VmfLobe lobe = lobes.lobe(i);
            densities[i] = lobes.weight[i] * vmf_peak(lobe.kappa) * vmf_falloff(lobe.mean, lobe.kappa, wi);
        }
        return sum_by_halves(densities);
    }
    /// The mixture at a point times the cosine to its normal.
    PL_HD LobeMixture product_at(std::uint32_t volume, Vec3f offset, Vec3f normal) const {
        return times_cosine(lobes_at(volume, offset), normal);
    }

    /// A position relative to the site of a volume, in units of the extent, in the frame of its normal; 0 without an extent.
    PL_HD Vec3f offset_of(std::int32_t volume, Vec3f position) const {
        if (!(extent > 0.0f)) return Vec3f{0.0f};
        const Vec3f difference = position - sites[static_cast<std::uint32_t>(volume)].position;
        return frame(volume).to_local(difference / extent);
    }
};

}  // namespace pl
