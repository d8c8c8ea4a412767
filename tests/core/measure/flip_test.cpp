// FLIP on pictures without structure, for which the paper's formulas can be followed by hand, and properties of all pictures.
#include "core/measure/flip.h"

#include <cmath>
#include <limits>
#include <random>

#include "core/base/error.h"
#include "tests/support/catch.hpp"

namespace pl::test {
namespace {

using Picture = std::vector<Vec3f>;

constexpr int kSide = 24;

Picture plain(Vec3f color) { return Picture(kSide * kSide, color); }

Picture random_picture(std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    std::uniform_real_distribution<float> uniform(0.0f, 1.2f);
    Picture picture(kSide * kSide);
    for (Vec3f& pixel : picture) pixel = {uniform(generator), uniform(generator), uniform(generator)};
    return picture;
}

double flip(const Picture& a, const Picture& b, double pixels_per_degree = kFlipPixelsPerDegree) {
    return mean_of(flip_map(a, b, kSide, pixels_per_degree));
}

float linear(double srgb) {
    return static_cast<float>(srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4));
}

}  // namespace

TEST_CASE("equal pictures differ nowhere, and the largest difference of colors is one") {
    const Picture a = random_picture(1);
    for (const float value : flip_map(a, a, kSide)) CHECK(value == 0.0f);
    // Green and blue are the ends of the scale.
    for (const float value : flip_map(plain({0, 1, 0}), plain({0, 0, 1}), kSide))
        CHECK_THAT(value, WithinAbs(1.0, 1e-6));
}

TEST_CASE("grays without structure by hand") {
    // Gray has no color, so only lightness counts: d = |L1 - L2|^0.7 with CIE lightness L. Green is at L = 87.735,
    // a = -86.183, b = 83.180 in CIELAB, blue at 32.299, 79.190, -107.865 (D65), times 0.01 L for the Hunt effect.
    const double green_lightness = 87.735, blue_lightness = 32.299;
    const double da = 0.01 * (-86.183 * green_lightness - 79.190 * blue_lightness);
    const double db = 0.01 * (83.180 * green_lightness + 107.865 * blue_lightness);
    const double largest = std::pow(green_lightness - blue_lightness + std::hypot(da, db), 0.7);
    const auto scaled = [&](double distance) {
        const double knee = 0.4 * largest;
        return distance < knee ? 0.95 * distance / knee : 0.95 + 0.05 * (distance - knee) / (largest - knee);
    };
    CHECK_THAT(flip(plain({1, 1, 1}), plain({0, 0, 0})), WithinAbs(scaled(std::pow(100.0, 0.7)), 2e-4));
    // Radiance 0.184187 is lightness 50.
    CHECK_THAT(flip(plain(Vec3f(0.1841865f)), plain({0, 0, 0})), WithinAbs(scaled(std::pow(50.0, 0.7)), 2e-4));
    CHECK_THAT(flip(plain(Vec3f(0.1841865f)), plain({1, 1, 1})), WithinAbs(scaled(std::pow(50.0, 0.7)), 2e-4));
}

TEST_CASE("a picture of gradients with a red square as the authors' program sees it") {
    // flip-evaluator 1.7 gives 0.0524613 for these 64 x 48 pixels in single precision.
    Picture reference;
    Picture picture;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) {
            reference.emplace_back(linear(x / 64.0), linear(y / 48.0), linear(0.5));
            const bool inside = x >= 10 && x < 20 && y >= 10 && y < 20;
            picture.push_back(inside ? Vec3f{1, 0, 0} : reference.back());
        }
    const std::vector<float> map = flip_map(picture, reference, 64);
    CHECK_THAT(mean_of(map), WithinAbs(0.0524613, 2e-6));
    CHECK(map[15 * 64 + 15] > 0.5f);
    CHECK(map[40 * 64 + 60] == 0.0f);
}

TEST_CASE("the same both ways round, between zero and one, and more the more they differ") {
    const Picture a = random_picture(2), b = random_picture(3);
    CHECK(flip_map(a, b, kSide) == flip_map(b, a, kSide));
    for (const float value : flip_map(a, b, kSide)) CHECK((value > 0.0f && value <= 1.0f));
    double before = 0.0;
    for (const float share : {0.1f, 0.3f, 1.0f}) {
        Picture between = a;
        for (std::size_t i = 0; i < between.size(); ++i) between[i] += share * (b[i] - a[i]);
        const double now = flip(a, between);
        CHECK(now > before);
        before = now;
    }
}

TEST_CASE("noise is seen less where pixels are finer") {
    const Picture a = random_picture(4), b = random_picture(5);
    CHECK(flip(a, b, 200.0) < flip(a, b, 67.0));
    CHECK(flip(a, b, 67.0) < flip(a, b, 20.0));
}

TEST_CASE("differences that a display cannot show count nothing") {
    CHECK(flip(plain(Vec3f(1.0f)), plain(Vec3f(100.0f))) == 0.0);
    CHECK(flip(plain(Vec3f(0.0f)), plain(Vec3f(-1.0f))) == 0.0);
    CHECK(flip(plain(Vec3f(0.0f)), plain(Vec3f(std::numeric_limits<float>::quiet_NaN()))) == 0.0);
    CHECK(flip(plain(Vec3f(1.0f)), plain(Vec3f(std::numeric_limits<float>::infinity()))) == 0.0);
}

TEST_CASE("sizes have to agree") {
    const Picture four(4);
    CHECK_THROWS_AS(flip_map(four, Picture(3), 2), Error);
    CHECK_THROWS_AS(flip_map(four, four, 3), Error);
    CHECK_THROWS_AS(flip_map(four, four, 0), Error);
    CHECK(flip_map(four, four, 1).size() == 4);
    CHECK(mean_of(flip_map({}, {}, 1)) == 0.0);
}

}  // namespace pl::test
