// Russian roulette keeps means and bounds weights, for any contribution estimate of a method.
#include "core/kernel/integrator/steps.h"
#include "core/kernel/methods/default.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"
#include "tests/support/statistics/rules.h"

using namespace pl;
using namespace pl::test;

namespace {

/// A method with a fixed contribution estimate.
struct FixedEstimate : DefaultMethod {
    float estimate = 0.0f;

    PL_HD float estimate_contribution(const Vertex&, Vec3f, Vec3f, float, Expectation&) const { return estimate; }
};

constexpr float kAlbedo = 0.75f;
constexpr int kVertices = 12;

/// Throughput of a path behind its last vertex; 0 if roulette ended it.
template <Method M>
float survive(const M& method, const PathSettings& settings, Uniforms& random) {
    PathState<FeatureSet{}, M> state;
    for (int vertex = 0; vertex < kVertices; ++vertex) {
        ++state.vertices;
        if (play_roulette(method, settings, typename M::Vertex{}, Vec3f{kAlbedo}, random.next(), state) == 0.0f)
            return 0.0f;
        state.throughput *= kAlbedo;
    }
    return state.throughput.x;
}

}  // namespace

// S1, N = 1,000,000 paths, seed 1: 5 % off would be found. The mean is albedo^12 = 0.0317, and every surviving path
// weighs at most 1.
TEST_CASE("Roulette keeps the mean and lets no weight grow, whatever the contribution estimate") {
    const double expected = std::pow(static_cast<double>(kAlbedo), kVertices);
    for (const float threshold : {0.01f, 1.0f})
        for (const float estimate : {0.0f, 1e-6f, 0.005f, 0.5f, 1.0f, 1e6f, kInfinity}) {
            INFO("estimate " << estimate << ", threshold " << threshold);
            FixedEstimate method;
            method.estimate = estimate;
            Uniforms random(1);
            Moments weights;
            float most = 0.0f;
            for (int path = 0; path < 1000000; ++path) {
                const float weight = survive(method, {.roulette_threshold = threshold}, random);
                weights.add(static_cast<double>(weight));
                most = std::max(most, weight);
            }
            CHECK(most <= 1.0f + 1e-5f);
            CHECK(mean_equals(weights, {expected, 1e-6}, 0.05));
        }
}

TEST_CASE("Roulette by reflectances alone ignores every estimate") {
    const double expected = std::pow(static_cast<double>(kAlbedo), kVertices);
    const auto played = [&](float estimate, float threshold) {
        FixedEstimate method;
        method.estimate = estimate;
        Uniforms random(2);
        Moments weights;
        for (int path = 0; path < 1000000; ++path)
            weights.add(static_cast<double>(
                survive(method, {.roulette_threshold = threshold, .roulette = RouletteRule::Albedo}, random)));
        return weights;
    };
    for (const float estimate : {0.0f, 0.5f, kInfinity}) {
        INFO("estimate " << estimate);
        const Moments weights = played(estimate, 0.01f);
        CHECK(mean_equals(weights, {expected, 1e-6}, 0.05));
        CHECK(weights.mean() == played(1.0f, 1.0f).mean());
    }
    CHECK(survival_probability({.roulette = RouletteRule::Albedo}, 0.0f, 0.5f) == 0.5f);
    CHECK(survival_probability({.roulette = RouletteRule::Albedo}, 0.0f, 0.01f) == kMinSurvival);
    CHECK(survival_probability({.roulette = RouletteRule::Spare}, kInfinity, 0.01f) == 1.0f);
    CHECK(survival_probability({.roulette = RouletteRule::Spare}, 0.0f, 0.5f) == 0.5f);
    CHECK(survival_probability({.roulette = RouletteRule::Spare}, 0.7f, 0.5f) == 0.7f);
}

namespace {

/// Vertices of a path until roulette may end it, of which the first ones are specular; all absorb nearly everything.
std::uint32_t vertices_before_roulette(const PathSettings& settings, std::uint32_t specular) {
    PathState<kLobeFeatures, DefaultMethod> state;
    for (;;) {
        ++state.vertices;
        if (state.vertices <= specular) count_specular(settings, state);
        constexpr float kNearOne = 0.999999f;
        if (play_roulette(DefaultMethod{}, settings, {}, Vec3f{0.01f}, kNearOne, state) == 0.0f)
            return state.vertices - 1;
    }
}

}  // namespace

TEST_CASE("Specular vertices do not count for the start of roulette, but for many of them") {
    const PathSettings settings{.roulette_start = 3};
    CHECK(vertices_before_roulette(settings, 0) == 2);
    CHECK(vertices_before_roulette(settings, 1) == 3);
    CHECK(vertices_before_roulette(settings, 4) == 6);
    CHECK(vertices_before_roulette(settings, kMostSpecularBeforeRoulette) == 2 + kMostSpecularBeforeRoulette);
    CHECK(vertices_before_roulette(settings, 1000) == 2 + kMostSpecularBeforeRoulette);
}

TEST_CASE("Specular vertices behind the first roulette count as others do") {
    const PathSettings settings{.roulette_start = 3};
    PathState<kLobeFeatures, DefaultMethod> state;
    state.vertices = 3;
    play_roulette(DefaultMethod{}, settings, {}, Vec3f{1.0f}, 0.0f, state);
    state.vertices = 4;
    count_specular(settings, state);
    CHECK(counted_vertices(state) == 4);
}
