// Shares of variance of random parts whose variances and covariances are known.
#include "core/diagnose/noise_sums.h"

#include <numeric>
#include <random>

#include "tests/support/catch.hpp"

using namespace pl;
using namespace pl::diagnose;

namespace {

double sum_of(std::span<const Interval> shares) {
    return std::accumulate(shares.begin(), shares.end(), 0.0,
                           [](double sum, const Interval& share) { return sum + share.value; });
}

/// A path of two independent parts with variances 3 and 1, and one that takes half of the first away again.
NoiseSums three_parts(std::uint32_t seed, int paths, double scale = 1.0) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    NoiseSums sums;
    for (int i = 0; i < paths; ++i) {
        const double a = std::sqrt(3.0) * normal(random);
        const double b = normal(random);
        const Contribution parts[] = {
            {.found_by = FoundBy::LightSampling, .bounces = 1, .light = scale * a},
            {.found_by = FoundBy::Bsdf, .bounces = 2, .light = scale * b},
            {.found_by = FoundBy::Bsdf, .bounces = 20, .is_distant = true, .light = scale * (5.0 - 0.5 * a)},
        };
        sums.add(static_cast<std::size_t>(i) % kJackknifeGroups, parts);
    }
    return sums;
}

const Interval& share_of(const NoiseShares& shares, FoundBy technique) {
    return shares.found_by[static_cast<std::size_t>(technique)];
}

}  // namespace

// T = a/2 + b + 5: Var T = 3/4 + 1 = 7/4. Cov(a, T) = 3/2, Cov(b, T) = 1, Cov(-a/2, T) = -3/4: shares 6/7, 4/7 and -3/7. 100 experiments
// of 3200 paths, seeds 1 to 100. Each 95 % interval misses in 5 of 100 on average; more than 15 has a probability below 1e-4, and
// intervals half as wide would miss in 33.
TEST_CASE("shares are covariances with the whole, and their intervals have the stated confidence") {
    std::array<int, 3> missed{};
    for (std::uint32_t seed = 1; seed <= 100; ++seed) {
        const PixelEstimate estimate = three_parts(seed, 3200).estimate();
        REQUIRE(estimate.shares);
        CHECK_THAT(sum_of(estimate.shares->found_by), WithinAbs(1.0, 1.0e-12));
        CHECK_THAT(sum_of(estimate.shares->bounces), WithinAbs(1.0, 1.0e-12));
        CHECK_THAT(sum_of(estimate.shares->lights), WithinAbs(1.0, 1.0e-12));
        missed[0] += share_of(*estimate.shares, FoundBy::LightSampling).contains(6.0 / 7.0) ? 0 : 1;
        missed[1] += share_of(*estimate.shares, FoundBy::Bsdf).contains(1.0 / 7.0) ? 0 : 1;
        missed[2] += estimate.shares->bounces[kBounceClasses - 1].contains(-3.0 / 7.0) ? 0 : 1;
        CHECK(estimate.shares->bounces[kBounceClasses - 1].value == estimate.shares->lights[1].value);
        CHECK(share_of(*estimate.shares, FoundBy::Field).value == 0.0);
    }
    for (const int count : missed) CHECK(count <= 15);
}

// Var T = 7/4, mean 5: 64000 paths have standard errors of 0.0098 and 0.0052; the tolerances are five of them.
TEST_CASE("mean and variance of a path") {
    const PixelEstimate estimate = three_parts(7, 64000).estimate();
    CHECK(estimate.paths == 64000);
    CHECK_THAT(estimate.variance.value, WithinAbs(1.75, 0.049));
    CHECK_THAT(estimate.mean.value, WithinAbs(5.0, 0.026));
    CHECK(estimate.variance.low < estimate.variance.value);
}

// Twice the spread at a third of the cost: 4 / 3 to the disadvantage. Variances of 6400 paths each have relative errors of 1.8 %; times
// are exact here.
TEST_CASE("the gain is the ratio of variances times seconds") {
    NoiseSums base = three_parts(11, 6400);
    NoiseSums method = three_parts(12, 6400, 2.0);
    for (std::size_t group = 0; group < kJackknifeGroups; ++group) {
        base.add_seconds(group, 3.0);
        method.add_seconds(group, 1.0);
    }
    const std::optional<Gain> gain = pixel_gain(base, method);
    REQUIRE(gain);
    CHECK_THAT(gain->samples.value, WithinRel(0.25, 0.13));
    CHECK_THAT(gain->cost.value, WithinRel(3.0, 1.0e-9));
    CHECK_THAT(gain->net.value, WithinRel(0.75, 0.13));
    CHECK(verdict_of(gain->net) == pl::Verdict::Slower);
    CHECK(verdict_of(pixel_gain(base, base)->net) == pl::Verdict::NoDifference);
}

TEST_CASE("without variance there are neither shares nor a gain") {
    NoiseSums still;
    const Contribution lamp[] = {{.found_by = FoundBy::Camera, .light = 2.0}};
    CHECK_FALSE(still.has_all_groups());
    for (std::size_t group = 0; group < kJackknifeGroups; ++group) still.add(group, lamp);
    still.add(0, lamp);
    CHECK(still.has_all_groups());
    const PixelEstimate estimate = still.estimate();
    CHECK(estimate.mean.value == 2.0);
    CHECK(estimate.variance.value == 0.0);
    CHECK_FALSE(estimate.shares);
    CHECK_FALSE(pixel_gain(still, three_parts(1, 320)));
}
