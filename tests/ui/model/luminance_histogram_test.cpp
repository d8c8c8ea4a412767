// Histograms of luminance: counts, percentiles, and the exposure that follows from them.
#include "ui/model/luminance_histogram.h"

#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/catch.hpp"

using namespace pl;
using namespace pl::ui;

TEST_CASE("Histogram: every pixel is counted once") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<Vec3f> pixels{Vec3f{1.0f}, Vec3f{0.0f},  Vec3f{1.0e-9f}, Vec3f{1.0e9f},
                                    Vec3f{nan},  Vec3f{-1.0f}, Vec3f{0.25f},   Vec3f{0.25f}};
    const LuminanceHistogram histogram = make_histogram(pixels);
    CHECK(histogram.pixels == 8);
    CHECK(histogram.dark == 3);
    CHECK(histogram.bright == 1);
    CHECK(histogram.invalid == 1);
    CHECK(histogram.counted() == 3);
    std::uint32_t sum = 0;
    for (const std::uint32_t count : histogram.counts) sum += count;
    CHECK(sum == 3);
}

TEST_CASE("Histogram: percentiles are those of the picture within a bin") {
    std::vector<Vec3f> pixels;
    for (int i = 0; i < 1000; ++i) pixels.emplace_back(std::exp2(-5.0f + 0.01f * static_cast<float>(i)));
    const LuminanceHistogram histogram = make_histogram(pixels);
    for (const float share : {0.05f, 0.25f, 0.5f, 0.95f})
        CHECK(std::fabs(*histogram.percentile(share) - (-5.0f + 10.0f * share)) < 0.25f);
    CHECK(std::fabs(*histogram.mean(0.05f, 0.95f)) < 0.25f);
    CHECK_FALSE(make_histogram({}).percentile(0.5f));
    CHECK_FALSE(make_histogram(std::vector<Vec3f>(9)).mean(0.0f, 1.0f));
}

TEST_CASE("Histogram: a large picture is looked at in part, evenly") {
    std::vector<Vec3f> pixels;
    for (int y = 0; y < 512; ++y)
        for (int x = 0; x < 512; ++x) pixels.emplace_back(x % 2 == 0 ? 0.5f : 2.0f);
    const LuminanceHistogram histogram = make_histogram(pixels, 1000);
    CHECK(histogram.pixels <= 1000);
    CHECK(histogram.pixels > 900);
    // Both kinds of columns: a step that is even would see one.
    CHECK(std::fabs(*histogram.mean(0.0f, 1.0f)) < 0.3f);
}

TEST_CASE("Automatic exposure: brings the mean to middle gray, whatever a few lamps do") {
    std::vector<Vec3f> pixels(1000, Vec3f{0.045f});  // two stops below
    CHECK(std::fabs(*automatic_exposure(make_histogram(pixels)) - 2.0f) < 0.15f);
    for (std::size_t i = 0; i < 40; ++i) pixels[i] = Vec3f{900.0f};
    CHECK(std::fabs(*automatic_exposure(make_histogram(pixels)) - 2.0f) < 0.15f);
    CHECK_FALSE(automatic_exposure(make_histogram(std::vector<Vec3f>(9))));
}
