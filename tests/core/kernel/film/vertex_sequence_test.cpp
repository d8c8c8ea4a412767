// Numbers of a path's first vertex: each is uniform, together they are spread evenly over the passes, and the halves of a film, the
// purposes and the pixels are independent.
#include "core/kernel/film/vertex_sequence.h"

#include <array>
#include <cmath>
#include <set>

#include "tests/support/catch.hpp"
#include "tests/support/statistics/sequences.h"

using namespace pl;

namespace {

Vec4f numbers_of(std::uint32_t pixel, std::uint32_t pass, Purpose purpose = Purpose::Scatter,
                 VertexSequences sequences = {}) {
    return vertex_uniforms(Rng{1, Stream::Picture, pixel, pass}, sequences, kSpreadVertex, purpose);
}

/// Mean of an integrand over every other pass of a pixel from `first` on, less its true mean.
template <class Integrand>
double deviation(std::uint32_t pixel, std::uint32_t first, std::uint32_t passes, Purpose purpose,
                 const Integrand& integrand, VertexSequences sequences = {}) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < passes; ++i) sum += integrand(numbers_of(pixel, first + 2 * i, purpose, sequences));
    return sum / passes;
}

/// Whether y and z lie in the quarter disk, less the probability.
double in_disk(Vec4f u) { return (u.y * u.y + u.z * u.z < 1.0f ? 1.0 : 0.0) - 0.25 * static_cast<double>(kPi); }

/// Square root of the mean square of the deviations of 2000 pixels.
template <class Integrand>
double spread_of(const Integrand& integrand) {
    double square = 0.0;
    for (std::uint32_t pixel = 0; pixel < 2000; ++pixel) {
        const double off = deviation(pixel, 0, 64, Purpose::Scatter, integrand);
        square += off * off / 2000.0;
    }
    return std::sqrt(square);
}

}  // namespace

TEST_CASE("Only first vertices of camera paths have numbers of a sequence") {
    for (const Stream stream : {Stream::Picture, Stream::Precompute, Stream::Placement, Stream::Inspection})
        for (std::uint32_t vertex = 0; vertex < 4; ++vertex) {
            const Rng rng{3, stream, 17, 9};
            const bool spread = stream == Stream::Picture && vertex == kSpreadVertex;
            CHECK((vertex_uniforms(rng, {8, 4}, vertex, Purpose::Light) == rng.draw(vertex, Purpose::Light)) !=
                  spread);
        }
}

// Seed 1.
TEST_CASE("Every pass alone has numbers that are uniform over the pixels") {
    test::check_passes_are_uniform([](std::uint32_t pixel, std::uint32_t pass) { return numbers_of(pixel, pass); });
}

TEST_CASE("The passes of a half form nets: 64 numbers in 64 intervals") {
    for (std::uint32_t pixel = 0; pixel < 200; ++pixel)
        for (const std::uint32_t half : {0u, 1u})
            for (std::uint32_t a = 0; a <= 6; ++a) {
                std::set<int> intervals, of_choice, of_kind;
                for (std::uint32_t i = 0; i < 64; ++i) {
                    const Vec4f u = numbers_of(pixel, 2 * i + half);
                    intervals.insert(static_cast<int>(std::ldexp(u.y, static_cast<int>(a))) * 64 +
                                     static_cast<int>(std::ldexp(u.z, static_cast<int>(6 - a))));
                    of_choice.insert(static_cast<int>(64.0f * u.x));
                    of_kind.insert(static_cast<int>(64.0f * u.w));
                }
                REQUIRE(intervals.size() == 64);
                REQUIRE(of_choice.size() == 64);
                REQUIRE(of_kind.size() == 64);
            }
}

TEST_CASE("The passes of a run form nets, whatever its first pass") {
    for (const std::uint32_t first : {1u, 2u, 5u, 64u, 1000u, 0xfffffff0u})
        for (std::uint32_t pixel = 0; pixel < 50; ++pixel)
            for (const std::uint32_t half : {0u, 1u}) {
                std::set<int> intervals;
                for (std::uint32_t i = 0; i < 16; ++i) {
                    const Vec4f u = numbers_of(pixel, first + half + 2 * i, Purpose::Scatter, {2 * first, first});
                    intervals.insert(static_cast<int>(4.0f * u.y) * 4 + static_cast<int>(4.0f * u.z));
                }
                REQUIRE(intervals.size() == 16);
            }
}

// Seed 1. Members of one sequence that follow each other even out the deviation of those before; fresh ones must not.
TEST_CASE("Runs have independent deviations, and each pass of one is uniform over the pixels") {
    for (const std::uint32_t first : {4u, 5u, 16u, 64u})
        test::check_independent([=](std::uint32_t pixel) {
            return std::array<double, 2>{
                deviation(pixel, first % 2, first / 2, Purpose::Scatter, in_disk),
                deviation(pixel, first, first / 2, Purpose::Scatter, in_disk, {2 * first, first})};
        });
    test::check_passes_are_uniform([](std::uint32_t pixel, std::uint32_t pass) {
        return numbers_of(pixel, 7 + pass, Purpose::Scatter, {14, 7});
    });
}

// Independent numbers would be off by sqrt(p (1-p) / 64): 0.051 for the disk, 0.063 for the choice and the disk together.
TEST_CASE("Means over the passes have a fraction of the deviation of independent numbers") {
    CHECK(spread_of(in_disk) < 0.051 / 3.0);
    CHECK(spread_of([](Vec4f u) { return static_cast<double>(u.x) - 0.5; }) < 0.036 / 10.0);
    CHECK(spread_of([](Vec4f u) { return static_cast<double>(u.w) - 0.5; }) < 0.036 / 10.0);
    // Of halves: 0.063 for independent numbers, 0.088 for shuffled sequences, whose blocks of powers of two stay together, 0.5 for one
    // member that follows another.
    CHECK(spread_of([](Vec4f u) { return (u.x < 0.5f) == (u.w < 0.5f) ? 0.5 : -0.5; }) < 0.1);
    CHECK(spread_of([](Vec4f u) { return (u.y < 0.5f) == (u.w < 0.5f) ? 0.5 : -0.5; }) < 0.1);
    CHECK(spread_of([](Vec4f u) { return (u.z < 0.5f) == (u.w < 0.5f) ? 0.5 : -0.5; }) < 0.1);
    const double p = 0.125 * static_cast<double>(kPi);
    CHECK(spread_of([=](Vec4f u) { return (u.x < 0.5f && u.y * u.y + u.z * u.z < 1.0f ? 1.0 : 0.0) - p; }) < 0.061);
}

// Seed 1. Noise is estimated from the difference of a film's halves.
TEST_CASE("Halves of a film, purposes and neighbors have independent deviations") {
    test::check_independent([](std::uint32_t pixel) {
        return std::array<double, 2>{deviation(pixel, 0, 16, Purpose::Scatter, in_disk),
                                     deviation(pixel, 1, 16, Purpose::Scatter, in_disk)};
    });
    test::check_independent([](std::uint32_t pixel) {
        return std::array<double, 2>{deviation(pixel, 0, 16, Purpose::Scatter, in_disk),
                                     deviation(pixel, 0, 16, Purpose::Light, in_disk)};
    });
    test::check_independent([](std::uint32_t pixel) {
        return std::array<double, 2>{deviation(2 * pixel, 0, 16, Purpose::Scatter, in_disk),
                                     deviation(2 * pixel + 1, 0, 16, Purpose::Scatter, in_disk)};
    });
}

// The number of a light sample must not depend on the number of the direction of the same pass. Seed 1.
TEST_CASE("Numbers of one pass are independent of each other") {
    using Numbers = double (*)(std::uint32_t);
    const Numbers pairs[][2] = {
        {[](std::uint32_t p) { return static_cast<double>(numbers_of(p, 6).x) - 0.5; },
         [](std::uint32_t p) { return static_cast<double>(numbers_of(p, 6).y) - 0.5; }},
        {[](std::uint32_t p) { return static_cast<double>(numbers_of(p, 6).y) - 0.5; },
         [](std::uint32_t p) { return static_cast<double>(numbers_of(p, 6).z) - 0.5; }},
        {[](std::uint32_t p) { return static_cast<double>(numbers_of(p, 6).x) - 0.5; },
         [](std::uint32_t p) { return static_cast<double>(numbers_of(p, 6, Purpose::Light).x) - 0.5; }},
    };
    for (const auto& pair : pairs)
        test::check_independent([&](std::uint32_t pixel) {
            return std::array<double, 2>{pair[0](pixel), pair[1](pixel)};
        });
}
