// Accumulation and display: invalid samples are counted and dropped, sums keep their digits, tone curves take every number.
#include "core/kernel/film/film_view.h"

#include <array>
#include <vector>

#include "core/kernel/film/tonemap.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"

using namespace pl;

namespace {

constexpr float kSubnormal = 1e-45f;

struct Film {
    std::vector<FilmPixel> pixels;

    explicit Film(std::uint32_t count) : pixels(count) {}
    FilmView view() { return {{pixels.data(), static_cast<std::uint32_t>(pixels.size())}, 1, 1}; }
};

bool is_nan(Vec3f value) { return value.x != value.x && value.y != value.y && value.z != value.z; }

/// As displays get it: 0 to 255, rounded.
int display_byte(float radiance, ToneCurve curve) {
    const float mapped = tone_map(Vec3f{radiance}, 1.0f, curve).y;
    return static_cast<int>(std::lround(255.0f * encode_srgb(mapped)));
}

}  // namespace

TEST_CASE("Invalid samples are counted and dropped") {
    Film film(1);
    CHECK(accumulate(film.view(), 0, {1, 2, 4}, 0));
    for (const float bad : {kNan, kInfinity, -kInfinity, -1.0f, -kSubnormal})
        for (int channel = 0; channel < 3; ++channel) {
            Vec3f sample{1.0f};
            sample[channel] = bad;
            CHECK_FALSE(accumulate(film.view(), 0, sample, 0));
        }
    CHECK(accumulate(film.view(), 0, {-0.0f, kSubnormal, 3e38f}, 1));
    const FilmPixel& pixel = film.pixels[0];
    CHECK(pixel.weight == 2);
    CHECK(pixel.invalid == 15);
    CHECK(pixel.sum.x == 1.0);
    CHECK(pixel.sum.y == 2.0 + static_cast<double>(kSubnormal));
    CHECK(mean_radiance(pixel).x == 0.5f);
}

TEST_CASE("A replacing sample removes the earlier ones") {
    Film film(2);
    accumulate(film.view(), 1, {1, 2, 4}, 1);
    accumulate(film.view(), 1, Vec3f{kNan}, 1);
    CHECK(replace_sample(film.view(), 1, Vec3f{3.0f}, 0));
    CHECK(film.pixels[1].weight == 1);
    CHECK(film.pixels[1].invalid == 0);
    CHECK(mean_radiance(film.pixels[1]) == Vec3f{3.0f});
    CHECK(film.pixels[1].second_weight == 0);
    CHECK(is_black(Vec3f{film.pixels[1].second_sum}));
    CHECK_FALSE(replace_sample(film.view(), 1, Vec3f{kInfinity}, 0));
    CHECK(film.pixels[1].weight == 0);
    CHECK(film.pixels[0].weight == 0);
}

TEST_CASE("A pixel without samples is black") {
    CHECK(mean_radiance(FilmPixel{}) == Vec3f{0.0f});
    Film film(1);
    accumulate(film.view(), 0, Vec3f{kNan}, 0);
    CHECK(mean_radiance(film.pixels[0]) == Vec3f{0.0f});
}

// A float sum of these stops growing at 2^24 or drifts by a percent.
TEST_CASE("Ten million samples lose nothing") {
    Film film(1);
    constexpr int kSamples = 10000000;
    for (int i = 0; i < kSamples; ++i)
        accumulate(film.view(), 0, {0.1f, 1.0f, i == 0 ? 1e6f : 1e-3f}, static_cast<std::uint32_t>(i));
    const FilmPixel& pixel = film.pixels[0];
    CHECK(pixel.weight == kSamples);
    CHECK(mean_radiance(pixel).x == 0.1f);
    CHECK(mean_radiance(pixel).y == 1.0f);
    const double expected = (1e6 + (kSamples - 1) * static_cast<double>(1e-3f)) / kSamples;
    CHECK(std::fabs(static_cast<double>(mean_radiance(pixel).z) / expected - 1.0) <= 1e-7);
    // The half without the bright sample: the difference of the two sums loses few of its digits.
    CHECK(std::fabs(static_cast<double>(half_mean(pixel, true).z) / static_cast<double>(1e-3f) - 1.0) <= 1e-7);
    CHECK(half_mean(pixel, false).x == 0.1f);
}

TEST_CASE("A pixel is one cache line") { CHECK(sizeof(FilmPixel) == 64); }

TEST_CASE("The number of a pass decides the half, and both halves make the whole") {
    Film film(1);
    const FilmPixel& pixel = film.pixels[0];
    CHECK(is_nan(half_mean(pixel, false)));
    accumulate(film.view(), 0, Vec3f{8.0f}, 6);
    CHECK(half_mean(pixel, false) == Vec3f{8.0f});
    CHECK(is_nan(half_mean(pixel, true)));
    accumulate(film.view(), 0, Vec3f{1.0f}, 7);
    accumulate(film.view(), 0, Vec3f{kNan}, 9);
    accumulate(film.view(), 0, Vec3f{3.0f}, 11);
    CHECK(half_mean(pixel, false) == Vec3f{8.0f});
    CHECK(half_mean(pixel, true) == Vec3f{2.0f});
    CHECK(mean_radiance(pixel) == Vec3f{4.0f});
    CHECK(pixel.weight == 3);
    CHECK(pixel.second_weight == 2);
    CHECK(pixel.invalid == 1);
}

TEST_CASE("The mean of a pixel, those of its halves and corrections take the weights of their passes") {
    Film film(1);
    FilmView view = film.view();
    const std::array<float, 4> values{12.0f, 6.0f, 4.0f, 5.0f};
    const std::array<std::uint32_t, 4> weights{1, 2, 3, 3};
    for (std::uint32_t pass = 0; pass < values.size(); ++pass) {
        view.weight = weights[pass];
        accumulate(view, 0, Vec3f{values[pass]}, pass);
    }
    accumulate(view, 0, Vec3f{kNan}, 4);
    const FilmPixel& pixel = film.pixels[0];
    CHECK(pixel.weight == 9);
    CHECK(pixel.second_weight == 5);
    CHECK(mean_radiance(pixel) == Vec3f{static_cast<float>(51.0 * (1.0 / 9.0))});
    CHECK(half_mean(pixel, false) == Vec3f{6.0f});
    CHECK(half_mean(pixel, true) == Vec3f{static_cast<float>(27.0 * (1.0 / 5.0))});
    correct_sample(view, 0, Vec3f{-2.0f}, 1, 2);
    CHECK(half_mean(pixel, false) == Vec3f{6.0f});
    CHECK(half_mean(pixel, true) == Vec3f{static_cast<float>(23.0 * (1.0 / 5.0))});
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
