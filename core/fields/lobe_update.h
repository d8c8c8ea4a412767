// The update of mixtures of lobes: one step of expectation-maximization, with the priors, the splits and the merges of Ruppert et al.
// 2020.
#pragma once

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

/// Absorbs all pending sums. The same bits for any number of threads.
void update_lobes(const FieldShape& shape, HostLobes& lobes, int threads);

}  // namespace pl
