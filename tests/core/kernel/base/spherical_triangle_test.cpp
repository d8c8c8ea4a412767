// Solid angles of triangles, and directions that are uniform in them.
#include "core/kernel/base/spherical_triangle.h"

#include "tests/support/catch.hpp"
#include "tests/support/numbers.h"
#include "tests/support/scenes/shapes.h"
#include "tests/support/statistics/sampling_rule.h"

using namespace pl;
using namespace pl::test;

namespace {

SphericalTriangle through(Vec3f a, Vec3f b, Vec3f c) {
    return {unpack(glm::normalize(a)), unpack(glm::normalize(b)), unpack(glm::normalize(c))};
}

/// On the inner side of all three planes through the origin, up to rounding.
bool contains(const SphericalTriangle& t, Vec3f direction) {
    const float side = dot(t.a, cross(t.b, t.c)) < 0.0f ? -1.0f : 1.0f;
    const auto is_inside = [&](const Real3<One>& p, const Real3<One>& q) {
        return side * dot(unpack(direction), cross(p, q)) > -1e-3f;
    };
    return is_inside(t.a, t.b) && is_inside(t.b, t.c) && is_inside(t.c, t.a);
}

Vec3f sample(const SphericalTriangle& t, float solid_angle, Vec2f u) {
    return pack(square_to_spherical_triangle(t, solid_angle, unpack(u)));
}

}  // namespace

TEST_CASE("Solid angle: octants, slices of a hemisphere and small triangles") {
    const Vec3f x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    CHECK(through(x, y, z).solid_angle() == Approx(0.5 * kHalfTurn));
    CHECK(through(x, z, y).solid_angle() == Approx(0.5 * kHalfTurn));  // either winding
    // Three directions near the horizon: a cap of height 1 - h, less its three slices.
    const auto low = [](float angle) { return Vec3f{std::cos(angle), std::sin(angle), 1e-3f}; };
    const float third = 2.0f * kPi / 3.0f;
    const float nearly_all = through(low(0.0f), low(third), low(2.0f * third)).solid_angle();
    CHECK(nearly_all > 6.26f);
    CHECK(nearly_all < 6.2832f);
    constexpr float s = 1e-2f;
    CHECK(through({0, 0, 1}, {s, 0, 1}, {0, s, 1}).solid_angle() == Approx(0.5 * 1e-4).epsilon(1e-3));
    CHECK(through(x, x, z).solid_angle() == 0.0f);
}

// The edges of the unit square map to the corners and sides, whatever the numbers: no NaN.
TEST_CASE("Spherical triangle: every number makes a unit direction inside") {
    test::Uniforms random(1);
    bool is_fine = true;
    for (int i = 0; i < 100000; ++i) {
        const SphericalTriangle t = through(random.direction(), random.direction(), random.direction());
        const float solid_angle = t.solid_angle();
        if (solid_angle < 1e-2f || solid_angle > 6.2f) continue;
        for (const Vec2f u : {random.square(), Vec2f{0.0f}, Vec2f{0.0f, 0.999999f}, Vec2f{0.999999f}}) {
            const Vec3f direction = sample(t, solid_angle, u);
            is_fine = is_fine && std::fabs(glm::length(direction) - 1.0f) < 1e-3f && contains(t, direction);
        }
    }
    CHECK(is_fine);
}

// Wide, narrow and obtuse triangles are cut by the planes through each corner and the middle of the opposite side into
// six parts, whose solid angles are known. S3: 5 degrees of freedom, N = 1e6, seed 3: parts off by 1 % are found.
TEST_CASE("Spherical triangle: directions are uniform") {
    test::Uniforms random(3);
    for (const SphericalTriangle& t :
         {through({1, 0, 0}, {0, 1, 0}, {0, 0, 1}), through({1, 0, 0.2f}, {0, 1, 0.2f}, {-1, -1, 0.3f}),
          through({0, 0, 1}, {0.1f, 0, 1}, {0, 2, 1}), through({2, 0, 1}, {-2, 0.3f, 1}, {0, -0.2f, 1}),
          // Nearly a quarter of the sphere, between two corners that are nearly opposite: each of its sides in turn.
          through({-0.6f, 0, -1e-2f}, {0.6f, 0, -1e-2f}, {0.6f, 0.8f, -1e-2f}),
          through({0.6f, 0.8f, -1e-2f}, {-0.6f, 0, -1e-2f}, {0.6f, 0, -1e-2f}),
          through({0.6f, 0, -1e-2f}, {0.6f, 0.8f, -1e-2f}, {-0.6f, 0, -1e-2f})}) {
        const float solid_angle = t.solid_angle();
        const Vec3f corner[3] = {pack(t.a), pack(t.b), pack(t.c)};
        const auto index_of = [&](Vec3f direction) {
            std::size_t index = 0;
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3f middle = corner[(i + 1) % 3] + corner[(i + 2) % 3];
                index = 2 * index + (glm::dot(direction, glm::cross(corner[i], middle)) > 0.0f ? 1 : 0);
            }
            return index;
        };
        const Vec3f center = pack(t.a + t.b + t.c);  // the three planes meet there
        std::vector<double> expected(8, 0.0);
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3f middle = corner[(i + 1) % 3] + corner[(i + 2) % 3];
            for (const std::size_t side : {1u, 2u}) {
                const Vec3f end = corner[(i + side) % 3];
                expected[index_of(middle + end + glm::normalize(center))] +=
                    static_cast<double>(through(center, middle, end).solid_angle());
            }
        }
        std::vector<std::uint64_t> counts(8);
        for (int i = 0; i < 1000000; ++i) ++counts[index_of(sample(t, solid_angle, random.square()))];
        std::vector<double> met;
        std::vector<std::uint64_t> found;
        for (std::size_t i = 0; i < 8; ++i) {
            if (expected[i] == 0.0) {
                CHECK(counts[i] == 0);
                continue;
            }
            met.push_back(expected[i]);
            found.push_back(counts[i]);
        }
        REQUIRE(met.size() == 6);
        CHECK(test::sampler_matches(found, met, 0.01));
    }
}
