#include "tests/parity/difference.h"

#include "tests/support/catch.hpp"

using namespace pl;
using namespace pl::parity;

namespace {

template <class T>
Difference difference_of(const std::vector<T>& a, const std::vector<T>& b) {
    Difference total;
    compare_arrays(total, a, b);
    return total;
}

}  // namespace

TEST_CASE("Differences are counted by value, to the bit") {
    CHECK(difference_of<float>({1.0f, 2.0f}, {1.0f, 2.0f}).is_none());
    const Difference one = difference_of<float>({1.0f, 2.0f, 3.0f, 4.0f}, {1.0f, 2.5f, 3.0f, 4.0f});
    CHECK(one.values == 4);
    CHECK(one.differing == 1);
    CHECK(one.share() == 0.25);
    CHECK(one.largest == 0.5);
    CHECK(difference_of<float>({0.0f}, {-0.0f}).differing == 1);
    CHECK(difference_of<std::uint32_t>({7, 5}, {3, 5}).largest == 4.0);
}

TEST_CASE("Vectors are compared by component") {
    const Difference difference = difference_of<Vec3f>({Vec3f{1.0f, 2.0f, 3.0f}}, {Vec3f{1.0f, 3.0f, 3.25f}});
    CHECK(difference.values == 3);
    CHECK(difference.differing == 2);
    CHECK(difference.largest == 1.0);
}

TEST_CASE("NaNs of the same bits are equal, a NaN beside a number is infinitely far") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(difference_of<float>({nan}, {nan}).is_none());
    CHECK(std::isinf(difference_of<float>({nan}, {1.0f}).largest));
}

TEST_CASE("Arrays of different lengths differ in every value") {
    const Difference difference = difference_of<float>({1.0f, 2.0f}, {1.0f});
    CHECK(difference.values == 2);
    CHECK(difference.differing == 2);
    CHECK(std::isinf(difference.largest));
}
