// Logarithmic axes: positions, and ticks with short labels.
#include "core/plot/log_axis.h"

#include <cmath>
#include <limits>

#include "tests/support/catch.hpp"

namespace pl::test {
namespace {

std::vector<std::string> labels_of(const LogAxis& axis, int most) {
    std::vector<std::string> labels;
    for (const AxisTick& tick : axis.ticks(most))
        if (!tick.label.empty()) labels.push_back(tick.label);
    return labels;
}

}  // namespace

TEST_CASE("equal factors are equal distances") {
    const LogAxis axis(0.1, 1000.0);
    CHECK(axis.position(axis.low()) == 0.0);
    CHECK(axis.position(axis.high()) == 1.0);
    CHECK_THAT(axis.position(1.0) - axis.position(0.1), WithinRel(axis.position(100.0) - axis.position(10.0), 1e-12));
    CHECK(axis.position(0.1) > 0.0);
    CHECK(axis.position(1000.0) < 1.0);
}

TEST_CASE("an exact axis has the given ends, and positions lead back to values") {
    const LogAxis axis = LogAxis::exactly(0.02, 5.0);
    CHECK(axis.low() == 0.02);
    CHECK(axis.high() == 5.0);
    for (const double position : {-0.5, 0.0, 0.3, 1.0, 1.7})
        CHECK_THAT(axis.position(axis.value_at(position)), WithinAbs(position, 1e-12));
    CHECK(LogAxis::exactly(3.0, 3.0).low() < LogAxis::exactly(3.0, 3.0).high());
}

TEST_CASE("ticks are 1, 2 and 5 while there is room") {
    CHECK((labels_of(LogAxis(0.9, 22.0), 10) == std::vector<std::string>{"1", "2", "5", "10", "20"}));
    CHECK((labels_of(LogAxis(0.9, 22.0), 4) == std::vector<std::string>{"1", "10"}));
    CHECK((labels_of(LogAxis(1e-9, 1e3), 5).size() <= 5));
    CHECK((labels_of(LogAxis(2e-7, 3e-7), 5) == std::vector<std::string>{"2e-07"}));
    // Lines of the minor grid between them.
    CHECK(LogAxis(1.0, 10.0).ticks(10).size() == 10);
    CHECK(tick_label(1e-5) == "1e-05");
    CHECK(tick_label(0.05) == "0.05");
}

TEST_CASE("nonsense gives an axis all the same") {
    const double infinity = std::numeric_limits<double>::infinity();
    for (const auto& [low, high] : std::vector<std::pair<double, double>>{
             {0.0, 1.0}, {-1.0, 1.0}, {2.0, 1.0}, {1.0, infinity}, {infinity, -infinity}, {NAN, 1.0}}) {
        const LogAxis axis(low, high);
        CHECK(axis.low() > 0.0);
        CHECK(axis.low() < axis.high());
        CHECK_FALSE(axis.ticks(5).empty());
    }
    const LogAxis point(3.0, 3.0);
    CHECK(point.low() < 3.0);
    CHECK(point.high() > 3.0);
}

}  // namespace pl::test
