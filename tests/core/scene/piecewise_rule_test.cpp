#include "core/scene/piecewise_rule.h"

#include <vector>

#include "tests/support/catch.hpp"

using namespace pl;

namespace {

template <class Function>
double integral(bool kink_at_begin, bool kink_at_end, Function function) {
    const QuadratureRule<8>& rule = piece_rule<8>(kink_at_begin, kink_at_end);
    double sum = 0.0;
    for (std::size_t i = 0; i < 8; ++i) sum += rule.weight[i] * function(rule.at[i]);
    return sum;
}

}  // namespace

TEST_CASE("Rules of pieces integrate polynomials, and square roots at the ends that have kinks") {
    for (const bool begin : {false, true})
        for (const bool end : {false, true}) {
            CAPTURE(begin, end);
            CHECK(integral(begin, end, [](double) { return 1.0; }) == Approx(1.0).epsilon(1e-13));
            CHECK(integral(begin, end, [](double x) { return x * x * x * x; }) == Approx(0.2).epsilon(1e-13));
            const double root = integral(begin, end, [](double x) { return std::sqrt(x); });
            const double root_of_rest = integral(begin, end, [](double x) { return std::sqrt(1.0 - x); });
            CHECK((std::fabs(root - 2.0 / 3.0) < 1e-5) == begin);
            CHECK((std::fabs(root_of_rest - 2.0 / 3.0) < 1e-5) == end);
        }
}

TEST_CASE("Pieces are in order, whatever order they are cut in, and have no cuts outside") {
    Pieces pieces(-1.0, 2.0);
    for (const double x : {1.0, -1.0, 0.25, 5.0, 2.0, -0.5, 1.5, -7.0}) pieces.cut(x);
    const std::vector<double> begins{-1.0, -0.5, 0.25, 1.0, 1.5};
    REQUIRE(pieces.count() == begins.size());
    for (std::size_t i = 0; i < begins.size(); ++i) {
        CHECK(pieces.begin(i) == begins[i]);
        CHECK(pieces.length(i) == (i + 1 < begins.size() ? begins[i + 1] : 2.0) - begins[i]);
        CHECK(pieces.is_first(i) == (i == 0));
        CHECK(pieces.is_last(i) == (i + 1 == begins.size()));
    }
}
