// The decision rules of every statistical test. A test that merely "does not reject" also passes when it has too few
// samples to see anything, so each rule has a second condition: the power to fail. Without it the verdict is
// Inconclusive, which is a failure as well.
#pragma once

#include <cassert>
#include <ostream>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/margin.h"
#include "tests/support/statistics/moments.h"

namespace pl::test {

/// Probability of a false alarm of one rule, two-sided: with 200 decisions a night one false alarm in 14 years.
inline constexpr double kAlpha = 1.0e-6;
/// Probability of missing a difference of the size that a test says it resolves.
inline constexpr double kBeta = 1.0e-3;
/// Standard normal quantiles of 1 - kAlpha/2 and 1 - kBeta.
inline constexpr double kZAlpha = 4.8916;
inline constexpr double kZBeta = 3.0902;

enum class Verdict { Pass, Fail, Inconclusive };

struct Decision {
    Verdict verdict = Verdict::Inconclusive;
    std::string reason;  ///< the numbers behind it

    explicit operator bool() const { return verdict == Verdict::Pass; }
};

inline std::ostream& operator<<(std::ostream& out, const Decision& decision) {
    constexpr const char* kNames[] = {"PASS", "FAIL", "INCONCLUSIVE"};
    return out << kNames[static_cast<int>(decision.verdict)] << ": " << decision.reason;
}

/// The worse of two decisions: failed, then undecided, then passed.
inline Decision worse_of(const Decision& a, const Decision& b) {
    const auto severity = [](const Decision& d) {
        return d.verdict == Verdict::Pass ? 0 : (d.verdict == Verdict::Inconclusive ? 1 : 2);
    };
    return severity(a) < severity(b) ? b : a;
}

/// The expected value of a mean, and a bound on the error of that value.
struct Reference {
    double value = 0.0;
    double error = 0.0;
};

/// Largest standard error with which a difference of `delta` is found with probability 1 - kBeta.
inline double resolving_error(double delta) { return delta / (kZAlpha + kZBeta); }

/// Rule S1: the mean equals the reference, and a relative difference of `delta` would have been seen.
inline Decision mean_equals(const Moments& samples, Reference reference, double delta) {
    const double error = samples.standard_error();
    const double difference = samples.mean() - reference.value;
    std::ostringstream reason;
    reason.precision(7);
    reason << "mean " << samples.mean() << " of " << samples.count() << ", expected " << reference.value
           << ", off by " << difference / error << " standard errors; standard error " << error
           << ", needed for a resolution of " << delta << ": " << resolving_error(delta * std::fabs(reference.value));
    note_used_share(std::fabs(difference) / (kZAlpha * error + reference.error));
    // Negated comparisons: NaN fails.
    if (!(std::fabs(difference) <= kZAlpha * error + reference.error)) return {Verdict::Fail, reason.str()};
    if (!(error <= resolving_error(delta * std::fabs(reference.value)))) return {Verdict::Inconclusive, reason.str()};
    return {Verdict::Pass, reason.str()};
}

/// Probability that chi^2 with `freedom` degrees exceeds `x`: the upper regularized incomplete gamma function
/// Q(freedom/2, x/2), by its series or its continued fraction.   [Press et al., Numerical Recipes, 3rd ed., 6.2]
inline double chi_squared_tail(double x, double freedom) {
    const double a = 0.5 * freedom;
    const double z = 0.5 * x;
    if (!(z > 0.0)) return 1.0;
    const double scale = std::exp(a * std::log(z) - z - std::lgamma(a));
    constexpr double kSmall = 1.0e-300;
    if (z < a + 1.0) {
        double term = 1.0 / a;
        double sum = term;
        for (double n = a + 1.0; term > sum * 1.0e-16; n += 1.0) {
            term *= z / n;
            sum += term;
        }
        return 1.0 - scale * sum;
    }
    double b = z + 1.0 - a;
    double c = 1.0 / kSmall;
    double d = 1.0 / b;
    double fraction = d;
    for (int i = 1; i < 10000; ++i) {
        const double an = -i * (i - a);
        b += 2.0;
        d = 1.0 / (std::fabs(an * d + b) < kSmall ? kSmall : an * d + b);
        c = std::fabs(b + an / c) < kSmall ? kSmall : b + an / c;
        const double factor = d * c;
        fraction *= factor;
        if (std::fabs(factor - 1.0) < 1.0e-15) break;
    }
    return scale * fraction;
}

/// The share of the way to a false alarm that a tail probability has gone.
inline double alarm_share(double tail) { return std::log(std::fmax(tail, 1.0e-300)) / std::log(kAlpha); }

/// Rule S3: samples follow a density, which gives `expected` counts per bin (their sum need not be the number of
/// samples: a density that does not integrate to 1 fails too). Neighboring bins are pooled until 10 are expected.
/// `delta` is the root mean square relative error of the density that would have been found.
inline Decision follows_density(std::span<const std::uint64_t> observed, std::span<const double> expected,
                                double delta) {
    assert(observed.size() == expected.size());
    struct Bin {
        double expected = 0.0;
        double observed = 0.0;
    };
    constexpr double kMinExpected = 10.0;
    std::vector<Bin> bins(1);
    bool impossible = false;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        impossible = impossible || (observed[i] > 0 && !(expected[i] > 0.0));
        if (bins.back().expected >= kMinExpected) bins.emplace_back();
        bins.back().expected += expected[i];
        bins.back().observed += static_cast<double>(observed[i]);
    }
    if (bins.size() > 1 && bins.back().expected < kMinExpected) {
        const Bin rest = bins.back();
        bins.pop_back();
        bins.back().expected += rest.expected;
        bins.back().observed += rest.observed;
    }
    double chi2 = 0.0;
    double total = 0.0;
    for (const Bin& bin : bins) {
        chi2 += std::pow(bin.observed - bin.expected, 2) / bin.expected;
        total += bin.expected;
    }
    const auto freedom = static_cast<int>(bins.size());
    const double tail = chi_squared_tail(chi2, freedom);
    const double needed = (kZAlpha + kZBeta) * std::sqrt(2.0 * freedom) / (delta * delta);
    std::ostringstream reason;
    reason << "chi^2 " << chi2 << " of " << freedom << " (tail " << tail << "), samples expected " << total
           << ", needed for a resolution of " << delta << ": " << needed
           << (impossible ? ", samples where the density is 0" : "");
    note_used_share(alarm_share(tail));
    if (impossible || !(tail >= kAlpha)) return {Verdict::Fail, reason.str()};
    return {total >= needed ? Verdict::Pass : Verdict::Inconclusive, reason.str()};
}

/// Means of independent batches of one picture: of square tiles and of the whole. Single pixels are never compared,
/// because per-pixel rules cannot see small global differences.
class TiledBatches {
public:
    static constexpr std::uint64_t kMinBatches = 64;

    TiledBatches(int width, int height, int tile = 16)
        : width_(width), tile_(tile), columns_((width + tile - 1) / tile),
          tiles_(static_cast<std::size_t>(columns_ * ((height + tile - 1) / tile))) {}

    /// One batch: the mean of the same number of samples for every pixel, rows of `width` values.
    void add(std::span<const double> pixels) {
        std::vector<Moments> means(tiles_.size());
        Moments whole;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const int x = static_cast<int>(i) % width_;
            const int y = static_cast<int>(i) / width_;
            means[static_cast<std::size_t>((y / tile_) * columns_ + x / tile_)].add(pixels[i]);
            whole.add(pixels[i]);
        }
        for (std::size_t t = 0; t < tiles_.size(); ++t) tiles_[t].add(means[t].mean());
        whole_.add(whole.mean());
    }

    const std::vector<Moments>& tiles() const { return tiles_; }
    const Moments& whole() const { return whole_; }

private:
    int width_;
    int tile_;
    int columns_;
    std::vector<Moments> tiles_;
    Moments whole_;
};

/// Rule S2: two renderings have the same mean, globally and tile by tile, and a global relative difference of
/// `delta` is eight standard errors. Welch's statistic: the two may differ in variance and in number of batches.
inline Decision same_mean(const TiledBatches& a, const TiledBatches& b, double delta) {
    assert(a.tiles().size() == b.tiles().size());
    const double error = std::hypot(a.whole().standard_error(), b.whole().standard_error());
    const double scale = 0.5 * std::fabs(a.whole().mean() + b.whole().mean());
    const double z = (a.whole().mean() - b.whole().mean()) / error;
    double chi2 = 0.0;
    int freedom = 0;
    for (std::size_t t = 0; t < a.tiles().size(); ++t) {
        const Moments& left = a.tiles()[t];
        const Moments& right = b.tiles()[t];
        const double difference = left.mean() - right.mean();
        const double variance = std::pow(left.standard_error(), 2) + std::pow(right.standard_error(), 2);
        // Tiles that both see no light at all say nothing.
        if (difference == 0.0 && variance == 0.0) continue;
        chi2 += difference * difference / variance;
        ++freedom;
    }
    const double tail = freedom > 0 ? chi_squared_tail(chi2, freedom) : 0.0;
    std::ostringstream reason;
    reason << "means " << a.whole().mean() << " and " << b.whole().mean() << ", Z " << z << ", tile chi^2 " << chi2
           << " of " << freedom << " (tail " << tail << "), relative standard error " << error / scale
           << ", needed for a resolution of " << delta << ": " << delta / 8.0;
    note_used_share(std::fmax(std::fabs(z) / kZAlpha, alarm_share(tail)));
    if (!(std::fabs(z) <= kZAlpha) || !(tail >= kAlpha)) return {Verdict::Fail, reason.str()};
    const bool enough =
        a.whole().count() >= TiledBatches::kMinBatches && b.whole().count() >= TiledBatches::kMinBatches;
    if (!enough || !(error <= delta / 8.0 * scale)) return {Verdict::Inconclusive, reason.str()};
    return {Verdict::Pass, reason.str()};
}

}  // namespace pl::test
