// The fit of one mixture of lobes to the moments of its training samples: the M step, splits and merges.
#pragma once

#include <array>

#include "core/fields/lobe_model.h"

namespace pl {

/// Prior of a lobe's weight, and of its mean cosine, in samples: as if so many had shown no direction at all. Counted are effective
/// samples, n (sum w)^2 / (n sum w^2), since few bright ones say little.   [Ruppert et al. 2020; OpenPGL; Kish 1965]
inline constexpr float kWeightPrior = 0.01f;
inline constexpr float kMeanCosinePrior = 0.2f;

/// A lobe is split if its chi-square exceeds this and it has so many effective samples.   [Ruppert et al. 2020; OpenPGL]
inline constexpr float kSplitMisfit = 0.5f;
inline constexpr float kFewestToSplit = 16.0f;
/// Two lobes become one if that changes the mixture by a smaller chi-square.
inline constexpr float kMergeMisfit = 0.025f;
/// Updates before a lobe that was split or merged is so again: each is one step of the fit.
inline constexpr std::uint32_t kSettled = 4;

/// A lobe with the moments that it follows from.
struct FittedLobe {
    std::array<float, kLobeMoments> moments{};
    VmfLobe lobe{};
    float weight = 0.0f;
    float inverse_distance = 0.0f;
    std::uint32_t age = 0;
};

/// Chi-square of one lobe in place of two of one mixture, times their weight: the integral of (pair - lobe)^2 / lobe, in closed form.
/// Infinite if the lobe is so narrow that it has none.
float merge_misfit(const FittedLobe& a, const FittedLobe& b, const VmfLobe& merged);

class MixtureFit {
public:
    /// `samples`: training samples that the moments are means of.
    MixtureFit(const HostLobes& lobes, std::uint32_t volume, double samples);

    /// Moves the moments of all lobes by `step` towards the means of the pending sums of `fresh` samples, and empties these.
    void absorb(HostLobes& lobes, float radiance_unit, std::uint32_t fresh, float step);
    /// Fits all lobes to their moments, then splits those that fit worst and merges the two nearest. False without any light.
    bool fit();
    void store(HostLobes& lobes) const;

private:
    float share_of(const FittedLobe& lobe) const { return lobe.moments[kMomentWeight] / total_; }
    float effective_samples(const FittedLobe& lobe) const;
    void fit_lobe(FittedLobe& lobe) const;
    void fit_weights();
    void split_worst();
    void split(std::size_t i);
    void merge_nearest();

    std::array<FittedLobe, kMostLobes> lobes_{};
    std::size_t count_;
    std::uint32_t volume_;
    double samples_;
    float total_ = 0.0f;  ///< of the weights' moments
};

}  // namespace pl
