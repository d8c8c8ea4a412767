// The denoised display: even light and what stays keep their values, edges stay, noise falls.
#include "core/inspect/denoise.h"

#include <cmath>
#include <random>

#include "tests/support/catch.hpp"

using namespace pl;

namespace {

/// A picture of a wall that is seen head-on, of two materials beside each other, an albedo that changes from pixel to pixel, and light.
struct Wall {
    static constexpr int kWidth = 96;
    static constexpr int kHeight = 64;

    FirstHits hits;
    std::vector<Vec3f> pixels;

    Wall() {
        hits.width = kWidth;
        hits.height = kHeight;
        for (int i = 0; i < 3; ++i) {
            hits.normal[i].assign(hits.count(), i == 2 ? 1.0f : 0.0f);
            hits.albedo[i].resize(hits.count());
        }
        hits.nearness.assign(hits.count(), 0.25f);
        for (auto& slope : hits.slope) slope.assign(hits.count(), 0.0f);
        hits.material.resize(hits.count());
        pixels.resize(hits.count());
        for (std::size_t i = 0; i < hits.count(); ++i) {
            hits.material[i] = is_left(i) ? 0.0f : 1.0f;
            for (int c = 0; c < 3; ++c) hits.albedo[c][i] = i % 5 == 0 ? 0.8f : 0.4f;
            pixels[i] = light(i) * Vec3f{hits.albedo[0][i]};
        }
    }
    static bool is_left(std::size_t i) { return i % kWidth < kWidth / 2; }
    static Vec3f light(std::size_t i) { return is_left(i) ? Vec3f{1.0f, 2.0f, 3.0f} : Vec3f{0.25f}; }
};

}  // namespace

TEST_CASE("Denoised display: light that is even on each material stays, under an albedo that changes") {
    const Wall wall;
    Denoiser denoiser;
    const auto shown = denoiser.denoise(wall.pixels, wall.hits, 1);
    REQUIRE(shown.size() == wall.pixels.size());
    float largest = 0.0f;
    for (std::size_t i = 0; i < shown.size(); ++i)
        for (int c = 0; c < 3; ++c) largest = std::max(largest, std::fabs(shown[i][c] / wall.pixels[i][c] - 1.0f));
    CHECK(largest < 1.0e-4f);
}

// Seed 1, 3072 pixels a side. The mean of exponential numbers, whose deviation is their mean, has to have a tenth of it: the filter sums
// over some hundred pixels.
TEST_CASE("Denoised display: noise falls to a tenth, and the mean of each material stays") {
    Wall wall;
    std::mt19937 random(1);
    std::exponential_distribution<float> noise(1.0f);
    for (Vec3f& pixel : wall.pixels) pixel *= noise(random);
    Denoiser denoiser;
    const auto shown = denoiser.denoise(wall.pixels, wall.hits, 1);
    for (const bool left : {true, false}) {
        double sum = 0.0, squares = 0.0, count = 0.0;
        for (std::size_t i = 0; i < shown.size(); ++i) {
            if (Wall::is_left(i) != left) continue;
            const double relative = shown[i].x / (Wall::light(i).x * wall.hits.albedo[0][i]);
            sum += relative;
            squares += relative * relative;
            ++count;
        }
        const double mean = sum / count;
        CAPTURE(left, mean);
        CHECK(std::fabs(mean - 1.0) < 0.1);
        CHECK(std::sqrt(squares / count - mean * mean) < 0.1);
    }
}

TEST_CASE("Denoised display: pixels without a value or a surface stay as they are, and touch no other") {
    Wall wall;
    const std::size_t nan = 20 * Wall::kWidth + 20;
    const std::size_t infinite = 30 * Wall::kWidth + 30;
    const std::size_t sky = 40 * Wall::kWidth + 20;
    wall.pixels[nan] = Vec3f{1.0f, kNan, 1.0f};
    wall.pixels[infinite] = Vec3f{kInfinity};
    wall.pixels[sky] = Vec3f{1000.0f};
    wall.hits.material[sky] = kNan;
    wall.hits.nearness[sky] = 0.0f;
    Denoiser denoiser;
    const auto shown = denoiser.denoise(wall.pixels, wall.hits, 1);
    CHECK(std::isnan(shown[nan].y));
    CHECK(shown[infinite].x == kInfinity);
    CHECK(shown[sky] == Vec3f{1000.0f});
    for (const std::size_t i : {nan, infinite, sky})
        CHECK(std::fabs(shown[i + 1].x / wall.pixels[i + 1].x - 1.0f) < 1.0e-4f);
}

TEST_CASE("Denoised display: surfaces at another depth or of another direction do not mix") {
    Wall wall;
    for (std::size_t i = 0; i < wall.hits.count(); ++i) {
        wall.hits.material[i] = 0.0f;
        const bool is_top = i / Wall::kWidth < Wall::kHeight / 2;
        if (Wall::is_left(i)) wall.hits.nearness[i] = 0.1f;
        wall.hits.normal[2][i] = is_top ? 1.0f : 0.0f;
        wall.hits.normal[1][i] = is_top ? 0.0f : 1.0f;
        if (!is_top) wall.pixels[i] *= 8.0f;
    }
    Denoiser denoiser;
    const auto shown = denoiser.denoise(wall.pixels, wall.hits, 1);
    for (std::size_t i = 0; i < shown.size(); ++i) REQUIRE(std::fabs(shown[i].x / wall.pixels[i].x - 1.0f) < 1.0e-4f);
}
