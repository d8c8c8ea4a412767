// The ratio of the costs of two kernels from passes in turns.
#include "core/measure/paired_cost.h"

#include <cmath>
#include <random>

#include "tests/support/catch.hpp"

using namespace pl;

namespace {

/// Adds passes until it is done; `seconds` gets (number of the pass, is it of the other kind).
template <class Seconds>
PairedCost measured(Seconds&& seconds) {
    PairedCost cost;
    for (int pass = 0; !cost.done(); ++pass) cost.add(seconds(pass, cost.next_is_other()));
    return cost;
}

}  // namespace

TEST_CASE("Paired cost: the ratio is found, and both times") {
    const auto result = measured([](int, bool other) { return other ? 3.0 : 2.0; }).result();
    CHECK(result.pairs == PairedCost::kPairs);
    CHECK(result.base_seconds == Approx(2.0));
    CHECK(result.other_seconds == Approx(3.0));
    CHECK(result.ratio.value == Approx(1.5));
}

TEST_CASE("Paired cost: a machine that grows slower favors neither kind") {
    const auto drift = [](int pass, bool) { return std::exp(0.05 * pass); };
    CHECK(measured(drift).result().ratio.value == Approx(1.0).epsilon(1e-9));
}

TEST_CASE("Paired cost: warm-up does not count, and a disturbed pair begins again") {
    PairedCost cost;
    CHECK_FALSE(cost.next_is_other());
    cost.add(100.0);
    CHECK(cost.next_is_other());
    cost.add(1.0);
    CHECK(cost.result().pairs == 0);
    CHECK(cost.next_is_other());  // the second pair begins with the other kind
    cost.add(50.0);
    cost.drop_pair();
    CHECK(cost.next_is_other());
    cost.add(4.0);
    cost.add(2.0);
    CHECK(cost.result().pairs == 1);
    CHECK(cost.result().ratio.value == Approx(2.0));
    CHECK(std::isinf(cost.result().ratio.high));
}

// 1000 experiments of 32 pairs, seed 1: a 95 % interval misses 50 of them, with a standard deviation of 7.
TEST_CASE("Paired cost: intervals hold the truth as often as they say") {
    std::mt19937_64 random(1);
    std::lognormal_distribution<double> noise(0.0, 0.05);
    int missed = 0;
    for (int experiment = 0; experiment < 1000; ++experiment) {
        const auto pass = [&](int, bool other) { return (other ? 1.1 : 1.0) * noise(random); };
        missed += measured(pass).result().ratio.contains(1.1) ? 0 : 1;
    }
    CHECK(missed > 50 - 28);
    CHECK(missed < 50 + 28);
}
