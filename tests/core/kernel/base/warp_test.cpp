// Maps from the unit square: inverses, areas and densities.
#include "core/kernel/base/warp.h"

#include <algorithm>

#include "tests/support/catch.hpp"
#include "tests/support/numbers.h"
#include "tests/support/scenes/shapes.h"
#include "tests/support/statistics/sampling_rule.h"

using namespace pl;
using namespace pl::test;

// Two maps with an error of a few roundoffs each, in coordinates up to 1; near the center directions are steep, but
// lengths are small.
TEST_CASE("Square to disk and back") {
    test::Uniforms random(1);
    float largest = 0.0f;
    bool inside = true;
    for (int i = 0; i < 2000000; ++i) {
        Vec2f u = random.square();
        if (i % 4 == 0) u = Vec2f{0.5f} + (u - Vec2f{0.5f}) * std::exp2(-20.0f * random.next());
        const Vec2f disk = square_to_disk(u);
        const Vec2f back = disk_to_square(disk);
        largest = max_of(largest, max_of(std::fabs(back.x - u.x), std::fabs(back.y - u.y)));
        inside = inside && glm::dot(disk, disk) <= 1.0f + 4.0f * kRoundoff && back.x >= 0.0f && back.x <= 1.0f &&
                 back.y >= 0.0f && back.y <= 1.0f;
    }
    CHECK(largest < 5e-7f);
    CHECK(inside);
}

TEST_CASE("Corners and edges and center of the square") {
    for (const float x : {0.0f, 0.5f, kAlmostOne, 1.0f})
        for (const float y : {0.0f, 0.5f, kAlmostOne, 1.0f}) {
            const Vec2f disk = square_to_disk({x, y});
            const Vec2f back = disk_to_square(disk);
            CHECK(std::fabs(back.x - x) < 5e-7f);
            CHECK(std::fabs(back.y - y) < 5e-7f);
            const Vec3f up = square_to_cosine_hemisphere({x, y});
            CHECK(up.z >= 0.0f);
            CHECK(std::fabs(glm::length(up) - 1.0f) < 1e-6f);
        }
    CHECK(square_to_disk({0.5f, 0.5f}) == Vec2f{0.0f});
    CHECK(disk_to_square({0.0f, 0.0f}) == Vec2f{0.5f});
}

// Equal areas: 12 x 12 cells of the square, found again after the round trip, are hit equally often; and the disk is
// covered uniformly, seen in 12 rings of equal area by 12 sectors. S3: 143 degrees of freedom, N = 5e6.
TEST_CASE("Square to disk keeps areas") {
    test::Uniforms random(2);
    constexpr int kSide = 12;
    std::vector<std::uint64_t> counts(kSide * kSide);
    for (int i = 0; i < 5000000; ++i) {
        const Vec2f disk = square_to_disk(random.square());
        const float ring = std::floor(glm::dot(disk, disk) * kSide);
        const float sector = std::floor((std::atan2(disk.y, disk.x) * kInvPi * 0.5f + 0.5f) * kSide);
        ++counts[static_cast<std::size_t>(min_of(static_cast<int>(ring), kSide - 1) * kSide +
                                          min_of(static_cast<int>(sector), kSide - 1))];
    }
    const std::vector<double> equal(kSide * kSide, 1.0 / (kSide * kSide));
    CHECK(test::sampler_matches(counts, equal, 0.007));
}

// Bins of equal solid angle; the probability of a ring is the difference of cos^2 at its borders.
TEST_CASE("The cosine hemisphere has the density it states") {
    test::Uniforms random(3);
    constexpr int kSide = 12;
    std::vector<std::uint64_t> counts(kSide * kSide);
    std::uint64_t below = 0;
    for (int i = 0; i < 5000000; ++i) {
        const Vec3f d = square_to_cosine_hemisphere(random.square());
        below += d.z >= 0.0f ? 0u : 1u;
        const float sector = std::floor((std::atan2(d.y, d.x) * kInvPi * 0.5f + 0.5f) * kSide);
        ++counts[static_cast<std::size_t>(min_of(static_cast<int>(d.z * kSide), kSide - 1) * kSide +
                                          min_of(static_cast<int>(sector), kSide - 1))];
    }
    std::vector<double> expected;
    for (int ring = 0; ring < kSide; ++ring)
        for (int sector = 0; sector < kSide; ++sector)
            expected.push_back((2.0 * ring + 1.0) / (kSide * kSide) / kSide);
    CHECK(below == 0);
    CHECK(test::sampler_matches(counts, expected, 0.007));
    // Midpoint rule in cos(theta), exact for a linear function.
    double integral = 0.0;
    for (int ring = 0; ring < 1000; ++ring)
        integral +=
            2.0 * 3.14159265358979 * 1e-3 * cosine_hemisphere_pdf_sa((static_cast<float>(ring) + 0.5f) * 1e-3f);
    CHECK(std::fabs(integral - 1.0) < 1e-6);
    CHECK(cosine_hemisphere_pdf_sa(0.0f) == 0.0f);
    CHECK(cosine_hemisphere_pdf_sa(-0.5f) == 0.0f);
}

// The triangle is cut into 12 x 12 similar triangles of equal area.
TEST_CASE("Triangles are covered uniformly") {
    test::Uniforms random(4);
    constexpr int kSide = 12;
    std::vector<std::uint64_t> counts(kSide * kSide);
    bool inside = true;
    for (int i = 0; i < 5000000; ++i) {
        const Vec2f b = square_to_triangle(random.square());
        inside = inside && b.x >= 0.0f && b.y >= 0.0f && b.x + b.y <= 1.0f;
        const float x = b.x * kSide;
        const float y = b.y * kSide;
        const int column = min_of(static_cast<int>(x), kSide - 1);
        const int row = min_of(static_cast<int>(y), kSide - 1 - column);
        const bool upper = x - static_cast<float>(column) + y - static_cast<float>(row) > 1.0f;
        // Row r has 2 (side - r) - 1 triangles; rows before it side^2 - (side - r)^2.
        const int before = kSide * kSide - (kSide - row) * (kSide - row);
        ++counts[static_cast<std::size_t>(before + 2 * column + (upper && row + column < kSide - 1 ? 1 : 0))];
    }
    const std::vector<double> equal(kSide * kSide, 1.0 / (kSide * kSide));
    CHECK(inside);
    CHECK(test::sampler_matches(counts, equal, 0.007));
}

TEST_CASE("Corners of the square stay inside the triangle") {
    for (const float x : {0.0f, 0.5f, kAlmostOne})
        for (const float y : {0.0f, 0.5f, kAlmostOne}) {
            const Vec2f b = square_to_triangle({x, y});
            CHECK(b.x >= 0.0f);
            CHECK(b.y >= 0.0f);
            CHECK(b.x + b.y <= 1.0f);
        }
}

TEST_CASE("A search of a distribution finds the interval of a number, among entries without probability, too") {
    test::Uniforms random(2);
    for (std::uint32_t count = 1; count <= 70; ++count) {
        std::vector<float> cdf;
        for (std::uint32_t i = 0; i < count; ++i) cdf.push_back(static_cast<float>(random.below(8)) / 8.0f);
        std::ranges::sort(cdf);
        cdf.back() = 1.0f;
        for (const float u : {0.0f, 0.125f, 0.3f, 0.5f, 0.874f, 0.875f, kAlmostOne}) {
            const auto expected = std::upper_bound(cdf.begin(), cdf.end() - 1, u) - cdf.begin();
            CHECK(find_interval(count, u, [&](std::uint32_t i) { return cdf[i]; }) == expected);
        }
    }
}
