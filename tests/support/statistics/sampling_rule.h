// Rule S3: counts of a sampler match the probabilities that its density promises, and a density wrong by a stated
// share would have been seen.
#pragma once

#include <vector>

#include "tests/support/statistics/rules.h"

namespace pl::test {

/// Bins that expect fewer samples than this are pooled: chi^2 is a bad approximation there.
inline constexpr double kMinExpected = 10.0;

/// Least N delta^2 (the non-centrality if every bin is off by `delta`) that is found with probability 1 - kBeta, in the
/// normal approximation of chi^2: mean k + L, variance 2k + 4L.
inline double needed_noncentrality(double freedom) {
    double low = 0.0;
    double high = 1.0e6;
    const double threshold = kZAlpha * std::sqrt(2.0 * freedom);
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (middle - kZBeta * std::sqrt(2.0 * freedom + 4.0 * middle) > threshold ? high : low) = middle;
    }
    return high;
}

/// `probabilities` add up to 1, or to less if the sampler may also fail. Any sample in a bin of probability 0
/// is a failure. `delta`: relative error of the density, alternating in sign from bin to bin, that must be found.
inline Decision sampler_matches(const std::vector<std::uint64_t>& counts, const std::vector<double>& probabilities,
                                double delta) {
    std::ostringstream reason;
    double samples = 0.0;
    for (const std::uint64_t count : counts) samples += static_cast<double>(count);
    double chi2 = 0.0;
    double freedom = -1.0;
    double pooled_expected = 0.0;
    double pooled_count = 0.0;
    double total = 0.0;
    for (const double p : probabilities) total += p;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const double expected = probabilities[i] / total * samples;
        const auto count = static_cast<double>(counts[i]);
        if (!(expected > 0.0) && counts[i] > 0) {
            reason << counts[i] << " samples in bin " << i << ", where the density is " << probabilities[i];
            return {Verdict::Fail, reason.str()};
        }
        pooled_expected += expected;
        pooled_count += count;
        if (pooled_expected < kMinExpected) continue;
        chi2 += (pooled_count - pooled_expected) * (pooled_count - pooled_expected) / pooled_expected;
        freedom += 1.0;
        pooled_expected = 0.0;
        pooled_count = 0.0;
    }
    const double tail = freedom > 0.0 ? chi_squared_tail(chi2, freedom) : 0.0;
    const double noncentrality = samples * delta * delta;
    reason << "chi^2 " << chi2 << " of " << freedom << " (tail " << tail << ") with " << samples
           << " samples; a density off by " << delta << " would add " << noncentrality
           << ", needed: " << needed_noncentrality(freedom);
    if (!(tail >= kAlpha)) return {Verdict::Fail, reason.str()};
    if (!(noncentrality >= needed_noncentrality(freedom))) return {Verdict::Inconclusive, reason.str()};
    return {Verdict::Pass, reason.str()};
}

}  // namespace pl::test
