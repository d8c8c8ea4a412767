// Positions of samples in a pixel: each is uniform, together they are stratified, and the halves of a film are independent.
#include "core/kernel/film/pixel_sequence.h"

#include <array>
#include <cmath>

#include "core/kernel/base/rng.h"
#include "tests/support/catch.hpp"
#include "tests/support/statistics/sequences.h"

using namespace pl;

namespace {

Vec4f sample_of(std::uint32_t pixel, std::uint32_t pass) {
    return pixel_sample(Rng{1, Stream::Picture, pixel, sequence_of(pass)}.draw(0, Purpose::Pixel), pass);
}

/// Share of the pixel's first `passes` samples on the film side of a line.
double covered(std::uint32_t pixel, std::uint32_t passes, double slope) {
    std::uint32_t inside = 0;
    for (std::uint32_t pass = 0; pass < passes; ++pass) {
        const Vec4f u = sample_of(pixel, pass);
        inside += static_cast<double>(u.y) - 0.5 < slope * (static_cast<double>(u.x) - 0.5) ? 1u : 0u;
    }
    return static_cast<double>(inside) / passes;
}

}  // namespace

TEST_CASE("Samples of a pixel are exact steps modulo 1, and below 1") {
    CHECK(moved_by_steps(0.25f, 0x80000000u, 0) == 0.25f);
    CHECK(moved_by_steps(0.25f, 0x80000000u, 1) == 0.75f);
    CHECK(moved_by_steps(0.25f, 0x80000000u, 2) == 0.25f);
    CHECK(moved_by_steps(0.25f, 0x80000000u, 0xffffffffu) == 0.75f);
    CHECK(moved_by_steps(1.0f - 0x1p-24f, 0, 7) == 1.0f - 0x1p-24f);
    CHECK(moved_by_steps(1.0f - 0x1p-24f, 0xffu, 1) == 1.0f - 0x1p-24f);
    CHECK(moved_by_steps(1.0f - 0x1p-24f, 0x100u, 1) == 0.0f);
    const Vec4f start{0.1f, 0.2f, 0.3f, 0.4f};
    for (const std::uint32_t pass : {0u, 1u}) {
        const Vec4f u = pixel_sample(start, pass);
        for (int i = 0; i < 4; ++i) CHECK(std::fabs(u[i] - start[i]) < 0x1p-23f);
    }
}

// Seed 1.
TEST_CASE("Every pass alone has samples that are uniform over the pixels") {
    test::check_passes_are_uniform(sample_of);
}

// The share of a pixel that lies on one side of a line through its center, from 128 samples: independent ones would be off by
// 0.5/sqrt(128) = 0.044, the root of the mean square. Seed 1, 2000 pixels. Some directions suit the sequence better than others.
TEST_CASE("Borders in a pixel are found by fewer samples than independent ones would take") {
    for (const double slope : {0.0, 0.3, 1.0, -2.5, 1e9}) {
        double square = 0.0;
        for (std::uint32_t pixel = 0; pixel < 2000; ++pixel) {
            const double off = covered(pixel, 128, slope) - 0.5;
            square += off * off / 2000.0;
        }
        INFO("slope " << slope);
        CHECK(std::sqrt(square) < 0.044 / 2.0);
    }
}

// Longer runs stay even: independent samples would be off by 5e-4.
TEST_CASE("Samples stay even over a million passes") {
    for (std::uint32_t pixel = 0; pixel < 4; ++pixel) CHECK(std::fabs(covered(pixel, 1u << 20, 0.3) - 0.5) < 1e-4);
}

// Noise is estimated from the difference of a film's halves: their errors must be independent. Seed 1.
TEST_CASE("The two halves of a film have errors that are independent") {
    constexpr std::uint32_t kPasses = 32;
    test::check_independent([](std::uint32_t pixel) {
        std::array<double, 2> off{};
        for (std::uint32_t pass = 0; pass < kPasses; ++pass) {
            const Vec4f u = sample_of(pixel, pass);
            off[pass % 2] += (u.y < u.x ? 1.0 : 0.0) - 0.5;
        }
        return off;
    });
}
