#include "core/measure/jackknife.h"

#include <array>
#include <bit>
#include <random>

#include "tests/support/catch.hpp"

using namespace pl;

namespace {

double mean_of(const std::array<double, 32>& values, GroupSet set) {
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i)
        if ((set >> i & 1u) != 0) sum += values[i];
    return sum / std::popcount(set);
}

std::array<double, 32> normal_values(std::mt19937& random, double mean) {
    std::normal_distribution<double> normal(mean, 1.0);
    std::array<double, 32> values{};
    for (double& value : values) value = normal(random);
    return values;
}

}  // namespace

TEST_CASE("the two halves share the groups between them, and each pair has one of both") {
    CHECK((kEvenGroups | kOddGroups) == kAllGroups);
    CHECK((kEvenGroups & kOddGroups) == 0);
    CHECK(std::popcount(3u & kEvenGroups) == 1);
}

TEST_CASE("the jackknife of a mean is Student's interval of the means of pairs") {
    std::mt19937 random(1);
    const std::array<double, 32> values = normal_values(random, 3.0);
    std::array<double, 16> pairs{};
    for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i] = 0.5 * (values[2 * i] + values[2 * i + 1]);
    const Interval expected = mean_interval(pairs);
    const Interval got = jackknife_interval([&](GroupSet set) { return mean_of(values, set); });
    CHECK_THAT(got.value, WithinRel(expected.value, 1.0e-12));
    CHECK_THAT(got.low, WithinRel(expected.low, 1.0e-9));
    CHECK_THAT(got.high, WithinRel(expected.high, 1.0e-9));
}

// The square of a mean of 32 unit normal numbers is 1/32 too high on average. 4000 experiments, seed 2: the standard error of the
// corrected mean is 0.0007, and of the plain one as small, so that both checks are at 5 of them or more.
TEST_CASE("two halves take the bias off a square") {
    std::mt19937 random(2);
    double plain = 0.0;
    double corrected = 0.0;
    constexpr int kExperiments = 4000;
    for (int i = 0; i < kExperiments; ++i) {
        const std::array<double, 32> values = normal_values(random, 0.0);
        const GroupFigure square = [&](GroupSet set) { return mean_of(values, set) * mean_of(values, set); };
        plain += square(kAllGroups) / kExperiments;
        corrected += without_bias(square, kAllGroups) / kExperiments;
    }
    CHECK_THAT(plain, WithinAbs(1.0 / 32.0, 0.0035));
    CHECK_THAT(corrected, WithinAbs(0.0, 0.0035));
}
