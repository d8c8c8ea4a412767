// Networks for vertices: the slopes of their loss, the same bits for all instruction sets and threads, mixtures that are sampled as
// their density says, what is learned, and a network that is given up.
#include <algorithm>
#include <functional>

#include "core/fields/reset_tables.h"
#include "cpu/mixture_slopes.h"
#include "cpu/neural_network.h"
#include "tests/support/catch.hpp"
#include "tests/support/field/neural_vertex_fixture.h"
#include "tests/support/field/random_tables.h"
#include "tests/support/scenes/random_values.h"
#include "tests/support/statistics/sampling_rule.h"
#include "tests/support/statistics/sphere.h"

using namespace pl;
using namespace pl::test;

namespace {

bool same_field(const HostNeuralVertex& a, const HostNeuralVertex& b) {
    bool same = true;
    zip(a, b, [&](const auto& left, const auto& right) {
        same = same && left.size() == right.size() &&
               std::memcmp(left.data(), right.data(), left.size() * sizeof(left[0])) == 0;
    });
    return same;
}

bool same_network(const HostNeuralVertex& a, const HostNeuralVertex& b) {
    bool same = true;
    for_each_vertex_array([&](const auto& spec) { same = same && spec.get(a) == spec.get(b); });
    return same;
}

/// Light in the cells of a hemisphere around a normal, by chance.
struct RandomLight {
    static constexpr std::uint32_t kCells = 36, kColumns = 64;
    std::vector<float> probability, x, y, z;
    Vec3f normal = glm::normalize(Vec3f{0.3f, -0.5f, 0.6f});

    RandomLight() : probability(kColumns), x(kColumns), y(kColumns), z(kColumns) {
        const DirectionCells cells{6};
        Uniforms random(5);
        float sum = 0.0f;
        for (std::uint32_t i = 0; i < kCells; ++i) {
            const Vec3f local =
                square_to_cosine_hemisphere(cells.point_in_cell(static_cast<int>(i), random.square()));
            x[i] = local.x;
            y[i] = local.y;
            z[i] = local.z;
            probability[i] = random.below(3) == 0 ? random.next() : 0.02f;
            sum += probability[i];
        }
        for (float& p : probability) p /= sum;
    }
    TaughtLight light() const { return {probability.data(), x.data(), y.data(), z.data(), kColumns, normal}; }

    /// Expected -ln of the density by which directions are sampled.
    double loss(const std::vector<float>& outputs) const {
        VertexMixture mixture;
        set_mixture(mixture, outputs.data(), normal);
        const Frame frame = make_frame(normal);
        double sum = 0.0;
        for (std::uint32_t i = 0; i < kCells; ++i) {
            const Vec3f wi = frame.to_world(Vec3f{x[i], y[i], z[i]});
            sum -= static_cast<double>(probability[i]) * std::log(static_cast<double>(mixture.pdf_sa(wi)));
        }
        return sum;
    }
};

/// All that the kernels of one instruction set compute for vertices.
std::vector<float> results_of(const NeuralKernels& kernels) {
    const RandomLight random;
    const std::vector<float> weights = random_values(kVertexLayout.count, -0.3f, 0.3f, 1);
    const std::vector<float> inputs = random_values(kInputs, -1.0f, 1.0f, 2);
    std::vector<float> all(kVertexColumns + kVertexOutputs);
    kernels.evaluate_vertex(weights.data(), inputs.data(), all.data());
    all.push_back(mixture_slopes(kernels, random.light(), all.data(), 0.1f, all.data() + kVertexColumns));
    return all;
}

/// Rule S3 for directions of a point.
Decision samples_follow_density(const NeuralVertexField& field, const SurfacePoint& point, std::uint64_t seed) {
    const NeuralVertexLocation location = field.locate(point);
    const std::vector<double> probabilities =
        cell_probabilities([&](Vec3f wi) { return field.density(location, point, wi).pdf_sa; });
    std::vector<std::uint64_t> counts(probabilities.size(), 0);
    Uniforms random(seed);
    for (int i = 0; i < 400000; ++i) {
        ScatterNumbers numbers;
        numbers.u = {0.0f, random.next(), random.next(), 0.0f};
        ++counts[cell_of(field.sample(location, point, numbers))];
    }
    return sampler_matches(counts, probabilities, 0.05);
}

/// Points on the plane between the sites of volumes, one with a bent normal.
std::vector<SurfacePoint> points_between() {
    return {TestNeuralVertex::point_at({0.31f, 0.52f, 0.0f}), TestNeuralVertex::point_at({0.9f, 0.1f, 0.0f}),
            TestNeuralVertex::point_at({0.5f, 0.5f, 0.0f}, {0.3f, 0.1f, 1.0f})};
}

}  // namespace

TEST_CASE("Every instruction set computes the same bits for a vertex") {
    const std::vector<float> expected = results_of(usable_neural_kernels().front());
    for (const NeuralKernels& kernels : usable_neural_kernels()) {
        INFO(kernels.isa);
        CHECK(results_of(kernels) == expected);
    }
}

TEST_CASE("A network asked for one vertex, with vectors or without, and for a block of volumes is the same") {
    const std::vector<float> weights = random_values(kVertexLayout.count, -0.3f, 0.3f, 3);
    const NetworkPoint point{{0.2f, 0.7f, 0.4f}, glm::normalize(Vec3f{0.1f, -0.4f, 0.3f})};
    float inputs[kInputs], alone[kVertexColumns], in_lanes[kVertexColumns];
    fill_inputs(point, weights.data(), inputs);
    evaluate_vertex_network(weights.data(), inputs, alone);
    best_neural_kernels().evaluate_vertex(weights.data(), inputs, in_lanes);
    NetworkBlock block(kVertexLayout);
    Network(best_neural_kernels(), kVertexLayout, weights.data()).predict(std::span(&point, 1), block);
    for (std::uint32_t i = 0; i < kVertexOutputs; ++i) {
        CHECK(alone[i] == in_lanes[i]);
        CHECK(alone[i] == block.outputs[i]);
    }
}

// The loss here is that of the mixture that is sampled, without the algebra of the slopes. Central differences in float densities.
TEST_CASE("The slopes of a mixture are those of its loss by finite differences") {
    const RandomLight random;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const std::vector<float> outputs = random_values(kVertexColumns, -1.5f, 1.5f, seed);
        std::vector<float> slopes(kVertexOutputs);
        const float loss = mixture_slopes(best_neural_kernels(), random.light(), outputs.data(), 1.0f, slopes.data());
        CHECK(static_cast<double>(loss) == Approx(random.loss(outputs)).epsilon(1e-4));
        for (std::uint32_t i = 0; i < kVertexOutputs; ++i) {
            constexpr float kStep = 1.0f / 256.0f;
            std::vector<float> moved = outputs;
            moved[i] += kStep;
            const double above = random.loss(moved);
            moved[i] -= 2.0f * kStep;
            const double difference = (above - random.loss(moved)) / (2.0 * static_cast<double>(kStep));
            INFO("output " << i << " of seed " << seed);
            CHECK(static_cast<double>(slopes[i]) == Approx(difference).epsilon(5e-3).margin(1e-3));
        }
    }
}

TEST_CASE("Lobes stay within the bounds of their concentration, and come back") {
    const RandomLight random;
    for (const float narrowness : {-50.0f, 50.0f}) {
        std::vector<float> outputs(kVertexColumns), slopes(kVertexOutputs);
        for (std::uint32_t k = 0; k < kVertexLobes; ++k) outputs[kLobeNarrowness * kVertexLobes + k] = narrowness;
        const float kappa = vertex_lobe(outputs_of(outputs.data(), 0), random.normal, 0).kappa;
        CHECK(kappa == Approx(std::exp(narrowness > 0.0f ? kMostNarrowness : kLeastNarrowness)));
        mixture_slopes(best_neural_kernels(), random.light(), outputs.data(), 1.0f, slopes.data());
        for (std::uint32_t k = 0; k < kVertexLobes; ++k)
            CHECK(slopes[kLobeNarrowness * kVertexLobes + k] * narrowness >= 0.0f);
    }
}

TEST_CASE("A fresh network guides nearly by the cosine, and knows nothing") {
    TestNeuralVertex vertex;
    const NeuralVertexField field = vertex.view();
    for (const Vec3f normal : {Vec3f{0, 0, 1}, Vec3f{1, 0, 0}, Vec3f{0.4f, -0.7f, -0.5f}}) {
        const Vec3f n = glm::normalize(normal);
        const VertexMixture mixture = field.mixture_at({0.4f, 0.6f, 0.0f}, n);
        const Frame frame = make_frame(n);
        Uniforms random(6);
        for (int i = 0; i < 1000; ++i) {
            const Vec3f local = square_to_sphere({0.55f + 0.45f * random.next(), random.next()});
            const float relative = mixture.pdf_sa(frame.to_world(local)) / (local.z * kInvPi);
            CHECK(relative > 0.2f);
            CHECK(relative < 2.5f);
        }
    }
    const NeuralVertexLocation location = field.locate(points_between()[0]);
    CHECK(location.is_served());
    CHECK(field.value_at(location) == 0.0f);
}

TEST_CASE("Densities of a network for vertices integrate to one at every point") {
    for (const int rounds : {0, 1, 8}) {
        TestNeuralVertex vertex;
        vertex.train(rounds);
        const NeuralVertexField field = vertex.view();
        for (const SurfacePoint& point : points_between()) {
            const NeuralVertexLocation location = field.locate(point);
            CHECK(integral_over_sphere([&](Vec3f wi) { return field.density(location, point, wi).pdf_sa; }) ==
                  Approx(1.0).epsilon(2e-3));
        }
    }
}

// Rule S3, false alarms 1e-6: 400 000 samples in 256 equal parts of the sphere; a density off by 5 % from part to part would be found.
TEST_CASE("Directions of a network for vertices follow their density") {
    TestNeuralVertex vertex;
    vertex.train(8);
    std::uint64_t seed = 1;
    for (const SurfacePoint& point : points_between()) CHECK(samples_follow_density(vertex.view(), point, seed++));
}

TEST_CASE("A network for vertices learns the light, also of volumes without training samples") {
    const auto divergence = [](int rounds, bool held_out) {
        TestNeuralVertex vertex;
        vertex.train(rounds);
        return vertex.mean_divergence(held_out);
    };
    const double fresh = divergence(0, false);
    const double early = divergence(6, false);
    const double late = divergence(32, false);
    const double held_out = divergence(32, true);
    INFO("fresh " << fresh << ", early " << early << ", late " << late << ", held out " << held_out);
    CHECK(early < fresh);
    CHECK(late < 0.3 * fresh);
    CHECK(held_out < 0.35 * fresh);
}

TEST_CASE("Threads change no bit of a network for vertices") {
    TestNeuralVertex one;
    one.train(3);
    CHECK(one.field.counts[kNetworkSteps] > 0);
    CHECK_FALSE(one.field.average == one.field.weights);
    for (const int threads : {2, 5}) {
        TestNeuralVertex other;
        other.train(3, threads);
        CHECK(same_field(one.field, other.field));
    }
}

TEST_CASE("A network for vertices learns nothing of darkness, and its tables only read") {
    TestNeuralVertex dark;
    const TestNeuralVertex fresh;
    dark.plane.field.pending_count[5] = 3;
    dark.update();
    CHECK(dark.field.counts[kNetworkSteps] == 0);
    CHECK(same_network(dark.field, fresh.field));
    TestNeuralVertex lit;
    lit.train(2);
    CHECK(same_tables(lit.field, lit.plane.tables()));
}

TEST_CASE("A table that is its uniform floor alone teaches nothing") {
    TestNeuralVertex vertex;
    vertex.plane.shape.uniform_floor = 1.0f;
    vertex.train(2);
    CHECK(vertex.field.counts[kNetworkSteps] > 0);
    CHECK(vertex.field.weights == TestNeuralVertex().field.weights);
}

// A volume without light must not pull at the weights of the others: the network of one lit volume is that of all with the rest dark.
TEST_CASE("Dark volumes have no slope") {
    const auto network_after = [](bool visits_others) {
        TestNeuralVertex vertex;
        const auto cells = static_cast<std::uint32_t>(vertex.plane.shape.cells.count());
        vertex.plane.field.pending_sum[7 * cells + 20] = to_fixed_point(4.0f, vertex.plane.shape.radiance_unit);
        vertex.plane.field.pending_count[7 * cells + 20] = 1;
        if (visits_others)
            for (std::uint32_t volume = 8; volume < 200; ++volume)
                vertex.plane.field.pending_count[volume * cells] = 50;
        vertex.update();
        return vertex.field;
    };
    const HostNeuralVertex alone = network_after(false);
    CHECK_FALSE(same_network(alone, TestNeuralVertex().field));
    CHECK(same_network(alone, network_after(true)));
}

TEST_CASE("A network for vertices that is not finite is given up, and paths are guided by the cosine") {
    for (const float damage : {kInfinity, kNan, 3e38f}) {
        TestNeuralVertex vertex;
        vertex.train(2);
        for (float& weight : vertex.field.weights) weight = damage;
        vertex.plane.record(3);
        vertex.update();
        CHECK(status_of(vertex.field).is_lost);
        CHECK_FALSE(damage_of(vertex.field).has_value());
        CHECK(std::ranges::all_of(vertex.field.average, [](float weight) { return std::isfinite(weight); }));
        const std::uint32_t steps = vertex.field.counts[kNetworkSteps];
        vertex.plane.record(4);
        vertex.update();
        CHECK(vertex.field.counts[kNetworkSteps] == steps);
        const NeuralVertexField field = vertex.view();
        for (const SurfacePoint& point : points_between()) {
            const NeuralVertexLocation location = field.locate(point);
            CHECK(location.mixture.lobes.weight[0] == 1.0f);
            CHECK(location.mixture.pdf_sa(point.shading_normal) == Approx(vmf_peak(kCosineKappa)));
            CHECK(field.value_at(location) > 0.0f);
            CHECK(samples_follow_density(field, point, 9));
        }
    }
}

TEST_CASE("Volumes of a network for vertices are divided and forgotten, the network stays") {
    TestNeuralVertex vertex;
    vertex.train(2);
    const FieldShape& shape = vertex.plane.shape;
    const std::vector<std::uint32_t> parents{1, 5};
    const HostNeuralVertex more = split_field(shape, vertex.field, parents);
    CHECK(fits(shape, more, vertex.plane.count() + 2));
    CHECK_FALSE(fits(shape, more, vertex.plane.count()));
    CHECK(same_network(more, vertex.field));
    CHECK(same_tables(more, split_field(shape, vertex.plane.tables(), parents)));
    HostField field = vertex.field;
    forget_volume(shape, vertex.plane.volumes, field, 1);
    CHECK(std::get<HostNeuralVertex>(field).mean_radiance[1] == 0.0f);
    CHECK(same_network(std::get<HostNeuralVertex>(field), vertex.field));
    HostNeuralVertex shorter = vertex.field;
    shorter.average.pop_back();
    CHECK_FALSE(fits(shape, shorter, vertex.plane.count()));
}

TEST_CASE("The bytes of a network for vertices are those of its tables, its weights and their means") {
    TestNeuralVertex vertex(8);
    CHECK(field_bytes(vertex.field) == vertex.plane.count() * table_bytes(64) + vertex_network_bytes());
    CHECK(status_of(vertex.field).bytes == vertex_network_bytes());
}
