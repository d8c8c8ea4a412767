// Accumulation and display: bad samples are counted and dropped, sums lose nothing, curves survive every number.
#include "core/kernel/film/film_view.h"

#include <vector>

#include "core/kernel/film/tonemap.h"
#include "tests/catch.hpp"
#include "tests/kernel/shapes.h"

using namespace pl;

namespace {

constexpr float kSubnormal = 1e-45f;

struct Film {
    std::vector<FilmPixel> pixels;

    explicit Film(std::uint32_t count) : pixels(count) {}
    FilmView view() { return {{pixels.data(), static_cast<std::uint32_t>(pixels.size())}, 1, 1}; }
};

/// As displays get it: 0 to 255, rounded.
int display_byte(float radiance, ToneCurve curve) {
    const float mapped = tone_map(Vec3f{radiance}, 1.0f, curve).y;
    return static_cast<int>(std::lround(255.0f * encode_srgb(mapped)));
}

}  // namespace

TEST_CASE("Invalid samples are counted and dropped") {
    Film film(1);
    CHECK(accumulate(film.view(), 0, {1, 2, 4}));
    for (const float bad : {kNan, kInfinity, -kInfinity, -1.0f, -kSubnormal})
        for (int channel = 0; channel < 3; ++channel) {
            Vec3f sample{1.0f};
            sample[channel] = bad;
            CHECK_FALSE(accumulate(film.view(), 0, sample));
        }
    CHECK(accumulate(film.view(), 0, {-0.0f, kSubnormal, 3e38f}));
    const FilmPixel& pixel = film.pixels[0];
    CHECK(pixel.samples == 2);
    CHECK(pixel.invalid == 15);
    CHECK(pixel.sum.x == 1.0);
    CHECK(pixel.sum.y == 2.0 + static_cast<double>(kSubnormal));
    CHECK(mean_radiance(pixel).x == 0.5f);
}

TEST_CASE("A sample that replaces leaves nothing of those before") {
    Film film(2);
    accumulate(film.view(), 1, {1, 2, 4});
    accumulate(film.view(), 1, Vec3f{kNan});
    CHECK(replace_sample(film.view(), 1, Vec3f{3.0f}));
    CHECK(film.pixels[1].samples == 1);
    CHECK(film.pixels[1].invalid == 0);
    CHECK(mean_radiance(film.pixels[1]) == Vec3f{3.0f});
    CHECK(film.pixels[1].sum_squared_luminance == Approx(9.0));
    CHECK_FALSE(replace_sample(film.view(), 1, Vec3f{kInfinity}));
    CHECK(film.pixels[1].samples == 0);
    CHECK(film.pixels[0].samples == 0);
}

TEST_CASE("A pixel without samples is black") {
    CHECK(mean_radiance(FilmPixel{}) == Vec3f{0.0f});
    Film film(1);
    accumulate(film.view(), 0, Vec3f{kNan});
    CHECK(mean_radiance(film.pixels[0]) == Vec3f{0.0f});
}

// A float sum of these stops growing at 2^24 or drifts by a percent.
TEST_CASE("Ten million samples lose nothing") {
    Film film(1);
    constexpr int kSamples = 10000000;
    for (int i = 0; i < kSamples; ++i) accumulate(film.view(), 0, {0.1f, 1.0f, i == 0 ? 1e6f : 1e-3f});
    const FilmPixel& pixel = film.pixels[0];
    CHECK(pixel.samples == kSamples);
    CHECK(mean_radiance(pixel).x == 0.1f);
    CHECK(mean_radiance(pixel).y == 1.0f);
    const double expected = (1e6 + (kSamples - 1) * static_cast<double>(1e-3f)) / kSamples;
    CHECK(std::fabs(static_cast<double>(mean_radiance(pixel).z) / expected - 1.0) <= 1e-7);
    // Variance from the sum of squares: 0.2126 * 0.1 + 0.7152 + little, all equal but one.
    CHECK(pixel.sum_squared_luminance > 0.0);
}

TEST_CASE("The sum of squares gives the variance of the luminance") {
    Film film(1);
    test::Uniforms random(1);
    double sum = 0.0;
    double squares = 0.0;
    for (int i = 0; i < 1000; ++i) {
        const Vec3f sample = random.cube(0, 10);
        accumulate(film.view(), 0, sample);
        const double y = 0.2126 * static_cast<double>(sample.x) + 0.7152 * static_cast<double>(sample.y) +
                         0.0722 * static_cast<double>(sample.z);
        sum += y;
        squares += y * y;
    }
    CHECK(film.pixels[0].sum_squared_luminance == Approx(squares).epsilon(1e-12));
    CHECK(luminance(mean_radiance(film.pixels[0])) == Approx(sum / 1000.0));
}

TEST_CASE("Display bytes of extreme numbers") {
    struct Row {
        float radiance;
        int clamp, reinhard, aces;
    };
    // 1/2 encodes to 187.5; the filmic curve reaches 2.51/2.43 > 1, so its limit is white.
    const Row rows[] = {
        {0.0f, 0, 0, 0},        {-0.0f, 0, 0, 0},           {kSubnormal, 0, 0, 0}, {1e-38f, 0, 0, 0},
        {-1.0f, 0, 0, 0},       {1.0f, 255, 188, 232},      {1e4f, 255, 255, 255}, {1e20f, 255, 255, 255},
        {3e38f, 255, 255, 255}, {kInfinity, 255, 255, 255}, {-kInfinity, 0, 0, 0}};
    for (const Row& row : rows) {
        INFO(row.radiance);
        CHECK(display_byte(row.radiance, ToneCurve::Clamp) == row.clamp);
        CHECK(display_byte(row.radiance, ToneCurve::Reinhard) == row.reinhard);
        CHECK(display_byte(row.radiance, ToneCurve::Aces) == row.aces);
    }
}

TEST_CASE("NaN in any channel shows as the marker") {
    const Vec3f marker{kInvalidMarker[0], kInvalidMarker[1], kInvalidMarker[2]};
    for (const ToneCurve curve : {ToneCurve::Clamp, ToneCurve::Reinhard, ToneCurve::Aces})
        for (int channel = 0; channel < 3; ++channel) {
            Vec3f radiance{0.5f};
            radiance[channel] = kNan;
            CHECK(tone_map(radiance, 1.0f, curve) == marker);
        }
}

TEST_CASE("Curves are monotone and stay in the unit interval at every exposure") {
    for (const ToneCurve curve : {ToneCurve::Clamp, ToneCurve::Reinhard, ToneCurve::Aces})
        for (const int stops : {-40, 0, 40}) {
            float before = 0.0f;
            for (float x = 1e-30f; x < 1e30f; x *= 1.01f) {
                const float y = tone_map(Vec3f{x}, std::ldexp(1.0f, stops), curve).x;
                // Neighbouring values may round against each other where the curve is flat: a few roundoffs.
                REQUIRE(y >= before - 4.0f * kRoundoff);
                REQUIRE(y >= 0.0f);
                REQUIRE(y <= 1.0f);
                before = y;
            }
            CHECK(before > 0.5f);
        }
}

TEST_CASE("The sRGB encoding is continuous and hits its ends") {
    CHECK(encode_srgb(0.0f) == 0.0f);
    CHECK(encode_srgb(1.0f) == Approx(1.0f).margin(1e-6));
    CHECK(std::fabs(encode_srgb(next_float_up(0.0031308f)) - encode_srgb(0.0031308f)) < 1e-5f);
    CHECK(encode_srgb(0.5f) == Approx(0.735357f).margin(1e-5));
}
