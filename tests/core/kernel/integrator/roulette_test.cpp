// Russian roulette and splitting keep means and bound weights, for any contribution estimate of a method.
#include <set>

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
        if (play_roulette(method, settings, typename M::Vertex{}, Vec3f{kAlbedo}, random.next(), state).branches == 0)
            return 0.0f;
        state.throughput *= kAlbedo;
    }
    return state.throughput.x;
}

/// A method that splits paths: its estimate is exact up to a factor, because every path has the same contribution.
struct Splitting : DefaultMethod {
    static constexpr bool kSplitsPaths = true;
    float factor = 1.0f;

    PL_HD float estimate_contribution(const Vertex&, Vec3f, Vec3f throughput, float, Expectation&) const {
        return factor * throughput.x;
    }
};

struct Family {
    float sum = 0.0f;   ///< of the throughputs of all branches behind their last vertex
    float most = 0.0f;  ///< the largest of them
    std::uint32_t branches = 1;
};

/// A path and its branches, one after the other as the integrator takes them.
Family trace_family(const Splitting& method, const PathSettings& settings, Uniforms& random) {
    PathState<FeatureSet{}, Splitting> state;
    PathStore<Splitting> store;
    keep_store(state, &store);
    Family family;
    for (;;) {
        bool ends = state.vertices == kVertices;
        if (ends) {
            family.sum += state.throughput.x;
            family.most = std::max(family.most, state.throughput.x);
        } else {
            ++state.vertices;
            const Continuation next = play_roulette(method, settings, {}, Vec3f{kAlbedo}, random.next(), state);
            ends = next.branches == 0;
            if (next.branches > 1)
                state.branches.wait(
                    {{}, {}, state.throughput, state.survival, state.vertices, next.branches - 1, {}});
            state.throughput *= kAlbedo;
        }
        if (!ends) continue;
        if (state.branches.waiting == 0) return family;
        const auto fork = state.branches.begin();
        state.throughput = fork.throughput * kAlbedo;
        state.survival = fork.survival;
        state.vertices = fork.vertices;
        ++family.branches;
    }
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

// By the rule that trusts the estimate alone weights may grow, up to 10 at a vertex; those opinions are left out that would
// need more paths than a test has. Reflectances alone ignore every estimate.
TEST_CASE("The other rules of roulette keep the mean, too") {
    const double expected = std::pow(static_cast<double>(kAlbedo), kVertices);
    const auto played = [&](RouletteRule rule, float estimate, float threshold) {
        FixedEstimate method;
        method.estimate = estimate;
        Uniforms random(2);
        Moments weights;
        for (int path = 0; path < 1000000; ++path)
            weights.add(
                static_cast<double>(survive(method, {.roulette_threshold = threshold, .roulette = rule}, random)));
        return weights;
    };
    for (const float estimate : {0.25f, 0.3f, 1.0f, kInfinity}) {
        INFO("estimate " << estimate);
        CHECK(mean_equals(played(RouletteRule::Field, estimate, 1.0f / 3.0f), {expected, 1e-6}, 0.05));
    }
    for (const float estimate : {0.0f, 0.5f, kInfinity}) {
        INFO("estimate " << estimate);
        const Moments weights = played(RouletteRule::Albedo, estimate, 0.01f);
        CHECK(mean_equals(weights, {expected, 1e-6}, 0.05));
        CHECK(weights.mean() == played(RouletteRule::Albedo, 1.0f, 1.0f).mean());
    }
    CHECK(survival_probability({.roulette = RouletteRule::Field}, kInfinity, 0.01f) == 1.0f);
    CHECK(survival_probability({.roulette = RouletteRule::Field}, 0.0f, 1.0f) == kMinSurvival);
    CHECK(survival_probability({.roulette = RouletteRule::Albedo}, 0.0f, 0.5f) == 0.5f);
    CHECK(survival_probability({.roulette = RouletteRule::Spare}, 0.0f, 0.5f) == 0.5f);
    CHECK(survival_probability({.roulette = RouletteRule::Spare}, 0.7f, 0.5f) == 0.7f);
}

// S1, N = 1,000,000 paths for good estimates and 200,000 for others, whose branches are many; seed 3: 2 % off would be found.
TEST_CASE("Split paths keep the mean and no path has more branches than it may") {
    const double expected = std::pow(static_cast<double>(kAlbedo), kVertices);
    for (const float factor : {1.0f, 4.0f, 30.0f, 1e6f, kInfinity}) {
        INFO("opinions " << factor << " times too high");
        Splitting method;
        method.factor = factor;
        Uniforms random(3);
        Moments sums;
        float most = 0.0f;
        std::uint32_t most_branches = 0;
        const int paths = factor < 10.0f ? 1000000 : 200000;
        for (int path = 0; path < paths; ++path) {
            const Family family = trace_family(method, {.roulette_threshold = 0.2f, .split_threshold = 2.0f}, random);
            sums.add(static_cast<double>(family.sum));
            most = std::max(most, family.most);
            most_branches = std::max(most_branches, family.branches);
        }
        CHECK(mean_equals(sums, {expected, 1e-6}, 0.02));
        CHECK(most <= 1.0f + 1e-5f);
        CHECK(most_branches <= kMostBranches);
        CHECK((most_branches == kMostBranches) == (factor >= 1e6f));
        if (factor == 1.0f) CHECK(most_branches == 1);
    }
}

TEST_CASE("Branches wait in the order of their vertices, the newest first, and draw numbers of their own") {
    PathState<FeatureSet{}, Splitting> state;
    PathStore<Splitting> store;
    keep_store(state, &store);
    std::set<std::uint32_t> drawn;
    const auto wait = [&](std::uint32_t vertices, std::uint32_t waiting) {
        state.branches.wait({{}, {}, Vec3f{1.0f}, 1.0f, vertices, waiting, {}});
    };
    for (std::uint32_t vertex = 1; vertex <= kMostForks; ++vertex) {
        CHECK(state.branches.room() > 1);
        wait(vertex, vertex);
    }
    CHECK(state.branches.room() == 1);
    for (std::uint32_t vertex = kMostForks; vertex >= 1; --vertex)
        for (std::uint32_t branch = 0; branch < vertex; ++branch) {
            state.vertices = state.branches.begin().vertices;
            CHECK(state.vertices == vertex);
            for (state.vertices = vertex; state.vertices <= 65536; state.vertices += 13107)
                CHECK(drawn.insert(state.draw_index()).second);
        }
    CHECK(state.branches.waiting == 0);
    CHECK(state.branches.forks == 0);
    CHECK(state.branches.number == kMostForks * (kMostForks + 1) / 2);
    CHECK(*drawn.rbegin() < (1u << 24));
}

namespace {

/// Vertices of a path until roulette may end it, of which the first ones are specular; all absorb nearly everything.
std::uint32_t vertices_before_roulette(const PathSettings& settings, std::uint32_t specular) {
    PathState<kLobeFeatures, DefaultMethod> state;
    for (;;) {
        ++state.vertices;
        if (state.vertices <= specular) count_specular(settings, state);
        constexpr float kAlmostOne = 0.999999f;
        if (play_roulette(DefaultMethod{}, settings, {}, Vec3f{0.01f}, kAlmostOne, state).branches == 0)
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
