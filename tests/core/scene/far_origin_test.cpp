// The origin of scenes far from the one of their coordinates.
#include "core/scene/far_origin.h"

#include "tests/support/catch.hpp"

using namespace pl;

TEST_CASE("Scenes near the origin stay where they are") {
    CHECK(far_origin({-1, -1, -1}, {1, 1, 1}) == glm::dvec3(0.0));
    CHECK(far_origin({0, 0, 0}, {0, 0, 0}) == glm::dvec3(0.0));
    CHECK(far_origin({60, 0, 0}, {61, 1, 1}) == glm::dvec3(0.0));
    CHECK(far_origin({-1e18, 0, 0}, {1e18, 1, 1}) == glm::dvec3(0.0));
}

TEST_CASE("The origin of a far scene is near it, along the axes on which it is far") {
    const glm::dvec3 low(391234.37, 5820123.81, 30.0);
    const glm::dvec3 high(391240.57, 5820133.81, 34.2);
    const glm::dvec3 origin = far_origin(low, high);
    CHECK(origin == glm::dvec3(391240.0, 5820128.0, 0.0));
    for (const double size : {1e-6, 1.0, 1e9}) {
        const glm::dvec3 scaled = far_origin(size * low, size * high);
        CHECK(glm::length(scaled - size * 0.5 * (low + high)) < size * 40.0);
        CHECK(scaled.z == 0.0);
    }
    // Bounds without an extent: a step of floats apart, at most.
    const glm::dvec3 point = far_origin({1e6, 2, 3}, {1e6, 2, 3});
    CHECK(std::abs(point.x - 1e6) <= 0.125);
    CHECK(point.y != 0.0);
}
