// Russian roulette keeps means and bounds weights, whatever a method thinks that a path is worth.
#include "core/kernel/integrator/steps.h"
#include "core/kernel/methods/default.h"
#include "tests/catch.hpp"
#include "tests/kernel/shapes.h"
#include "tests/statistical/rules.h"

using namespace pl;
using namespace pl::test;

namespace {

/// A method with a fixed opinion.
struct Opinionated : DefaultMethod {
    float opinion = 0.0f;

    PL_HD float roulette_worth(const Vertex&, Vec3f, Vec3f, float, Expectation&) const { return opinion; }
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

// S1, N = 1,000,000 paths, seed 1: 5 % off would be found. The mean is albedo^12 = 0.0317, and every path that is left
// weighs at most 1.
TEST_CASE("Roulette keeps the mean and lets no weight grow, right or wrong about what a path is worth") {
    const double expected = std::pow(static_cast<double>(kAlbedo), kVertices);
    for (const float threshold : {0.01f, 1.0f})
        for (const float opinion : {0.0f, 1e-6f, 0.005f, 0.5f, 1.0f, 1e6f, kInfinity}) {
            INFO("worth " << opinion << ", threshold " << threshold);
            Opinionated method;
            method.opinion = opinion;
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

// By the rule that trusts the opinion alone weights may grow, up to 10 at a vertex; those opinions are left out that would
// need more paths than a test has. Reflectances alone ignore every opinion.
TEST_CASE("The other rules of roulette keep the mean, too") {
    const double expected = std::pow(static_cast<double>(kAlbedo), kVertices);
    const auto played = [&](RouletteRule rule, float opinion, float threshold) {
        Opinionated method;
        method.opinion = opinion;
        Uniforms random(2);
        Moments weights;
        for (int path = 0; path < 1000000; ++path)
            weights.add(
                static_cast<double>(survive(method, {.roulette_threshold = threshold, .roulette = rule}, random)));
        return weights;
    };
    for (const float opinion : {0.25f, 0.3f, 1.0f, kInfinity}) {
        INFO("worth " << opinion);
        CHECK(mean_equals(played(RouletteRule::Field, opinion, 1.0f / 3.0f), {expected, 1e-6}, 0.05));
    }
    for (const float opinion : {0.0f, 0.5f, kInfinity}) {
        INFO("worth " << opinion);
        const Moments weights = played(RouletteRule::Albedo, opinion, 0.01f);
        CHECK(mean_equals(weights, {expected, 1e-6}, 0.05));
        CHECK(weights.mean() == played(RouletteRule::Albedo, 1.0f, 1.0f).mean());
    }
    CHECK(survival_probability({.roulette = RouletteRule::Field}, kInfinity, 0.01f) == 1.0f);
    CHECK(survival_probability({.roulette = RouletteRule::Field}, 0.0f, 1.0f) == kMinSurvival);
    CHECK(survival_probability({.roulette = RouletteRule::Albedo}, 0.0f, 0.5f) == 0.5f);
    CHECK(survival_probability({.roulette = RouletteRule::Spare}, 0.0f, 0.5f) == 0.5f);
    CHECK(survival_probability({.roulette = RouletteRule::Spare}, 0.7f, 0.5f) == 0.7f);
}
