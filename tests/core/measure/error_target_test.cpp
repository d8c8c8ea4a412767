// The budget of measuring, a share of the measured time: by hand, with made-up seconds.
#include "core/measure/error_target.h"

#include <limits>

#include "tests/support/catch.hpp"

namespace pl::test {

TEST_CASE("measuring stays within its share, and the first one is always allowed") {
    MeasureBudget budget(0.01);
    CHECK(budget.allows(0.001));
    budget.spend(0.02);
    CHECK_FALSE(budget.allows(2.0));  // 0.02 s is all of its share, and another one would take as long
    CHECK_FALSE(budget.allows(3.99));
    CHECK(budget.allows(4.01));
    CHECK_FALSE(budget.allows(4.01, 2));
    CHECK(budget.allows(6.01, 2));
    budget.spend(0.001);  // a cheap one
    CHECK_FALSE(budget.allows(2.19));
    CHECK(budget.allows(2.21));
    CHECK(budget.spent_seconds() == Approx(0.021));
}

TEST_CASE("a thousand measurements in a row of passes never exceed their share") {
    MeasureBudget budget(0.01);
    int taken = 0;
    double charged = 0.0;
    for (int pass = 0; pass < 100000; ++pass) {
        charged += 0.01;
        if (!budget.allows(charged)) continue;
        budget.spend(0.005 + 0.00005 * (pass % 7));
        ++taken;
        CHECK((taken == 1 || budget.spent_seconds() <= 0.01 * charged + 0.0003));
    }
    CHECK(taken > 1000);
}

TEST_CASE("a measurement in any case is expected to last, and uses no share") {
    MeasureBudget budget(0.01);
    budget.note(0.02);
    CHECK(budget.spent_seconds() == 0.0);
    CHECK_FALSE(budget.allows(1.99));
    CHECK(budget.allows(2.01));
}

TEST_CASE("a measurement that will take longer has to fit in beforehand") {
    MeasureBudget budget(0.01);
    budget.spend(0.02);
    budget.expect_more(0.01);
    CHECK_FALSE(budget.allows(4.99));
    CHECK(budget.allows(5.01));
    budget.spend(0.03);
    CHECK(budget.allows(8.01));  // measured now, no longer guessed
}

TEST_CASE("an infinite share allows everything") {
    MeasureBudget budget(std::numeric_limits<double>::infinity());
    CHECK(budget.allows(0.0));
    budget.spend(1e9);
    CHECK(budget.allows(1e-9));
}

}  // namespace pl::test
