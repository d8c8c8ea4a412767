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
    PathState<M> state;
    for (int vertex = 0; vertex < kVertices; ++vertex) {
        ++state.vertices;
        if (!survives_roulette(method, settings, {}, Vec3f{kAlbedo}, random.next(), state)) return 0.0f;
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
