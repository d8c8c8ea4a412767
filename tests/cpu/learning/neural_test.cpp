// The network of neural fields: the slopes of its loss, the same bits for all instruction sets and threads, mixtures that are sampled as
// their density says, what is learned, and a network that is given up.
#include <algorithm>
#include <functional>

#include "core/fields/field_model.h"
#include "cpu/learning/neural_network.h"
#include "tests/support/catch.hpp"
#include "tests/support/field/neural_fixture.h"
#include "tests/support/field/random_tables.h"
#include "tests/support/scenes/random_values.h"
#include "tests/support/statistics/sampling_rule.h"
#include "tests/support/statistics/sphere.h"

using namespace pl;
using namespace pl::test;

namespace {

bool same_field(const HostNeural& a, const HostNeural& b) {
    bool same = true;
    zip(a, b, [&](const auto& left, const auto& right) {
        same = same && left.size() == right.size() &&
               std::memcmp(left.data(), right.data(), left.size() * sizeof(left[0])) == 0;
    });
    return same;
}

bool same_network(const HostNeural& a, const HostNeural& b) {
    bool same = true;
    for_each_network_array([&](const auto& spec) { same = same && spec.get(a) == spec.get(b); });
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

/// All that the kernels of one instruction set compute of random numbers.
std::vector<float> results_of(const LaneKernels& kernels) {
    const RandomLight random;
    const std::vector<float> weights = random_values(kNetworkWeights, -0.3f, 0.3f, 1);
    const std::vector<float> inputs = random_values(kInputs, -1.0f, 1.0f, 2);
    std::vector<float> all(kVertexColumns + kVertexOutputs);
    kernels.evaluate_vertex(weights.data(), inputs.data(), all.data());
    all.push_back(mixture_slopes(kernels, random.light(), all.data(), 0.1f, all.data() + kVertexColumns));
    const auto keep = [&](const std::vector<float>& values) { all.insert(all.end(), values.begin(), values.end()); };
    constexpr std::uint32_t kColumns = 2 * kColumnBlock;
    std::vector<float> weight = random_values(kColumns, -1.0f, 1.0f, 3);
    std::vector<float> mean = random_values(kColumns, -1.0f, 1.0f, 4);
    std::vector<float> square = random_values(kColumns, 0.0f, 1.0f, 5);
    const std::vector<float> slopes = random_values(kColumns, -1.0f, 1.0f, 6);
    kernels.descend({weight.data(), mean.data(), square.data(), slopes.data(), kColumns, 0.01f, 1.5f});
    keep(weight);
    keep(mean);
    keep(square);
    const std::vector<float> a = random_values(8 * 20, -1.0f, 1.0f, 7);
    const std::vector<float> b = random_values(20 * std::size_t{kColumns}, -1.0f, 1.0f, 8);
    std::vector<float> c(8 * std::size_t{kColumns}, 0.5f);
    for (const bool adds : {false, true})
        kernels.multiply({a.data(), 20, 1, b.data(), kColumns, c.data(), kColumns, 8, 20, kColumns, adds});
    keep(c);
    return all;
}

/// Rule S3 for directions of a point.
Decision samples_follow_density(const NeuralField& field, const SurfacePoint& point, std::uint64_t seed) {
    const NeuralLocation location = field.locate(point);
    const std::vector<double> probabilities =
        cell_probabilities([&](Vec3f wi) { return field.density(location, point, wi).pdf_sa; });
    std::vector<std::uint64_t> counts(probabilities.size(), 0);
    Uniforms random(seed);
    for (int i = 0; i < 400000; ++i) {
        ScatterUniforms numbers;
        numbers.u = {0.0f, random.next(), random.next(), 0.0f};
        ++counts[cell_of(field.sample(location, point, numbers))];
    }
    return sampler_matches(counts, probabilities, 0.05);
}

/// Points on the plane between the sites of volumes, one with a bent normal.
std::vector<SurfacePoint> points_between() {
    return {TestNeural::point_at({0.31f, 0.52f, 0.0f}), TestNeural::point_at({0.9f, 0.1f, 0.0f}),
            TestNeural::point_at({0.5f, 0.5f, 0.0f}, {0.3f, 0.1f, 1.0f})};
}

}  // namespace

TEST_CASE("Every instruction set computes the same bits of a network") {
    const std::vector<float> expected = results_of(usable_lane_kernels().front());
    for (const LaneKernels& kernels : usable_lane_kernels()) {
        INFO(kernels.isa);
        CHECK(results_of(kernels) == expected);
    }
}

TEST_CASE("A network asked for one vertex, with vectors or without, and for a block of volumes is the same") {
    const std::vector<float> weights = random_values(kNetworkWeights, -0.3f, 0.3f, 3);
    const NetworkPoint point{{0.2f, 0.7f, 0.4f}, glm::normalize(Vec3f{0.1f, -0.4f, 0.3f})};
    float inputs[kInputs], alone[kVertexColumns], in_lanes[kVertexColumns];
    fill_inputs(point, weights.data(), inputs);
    evaluate_vertex_network(weights.data(), inputs, alone);
    best_lane_kernels().evaluate_vertex(weights.data(), inputs, in_lanes);
    NetworkBlock block;
    Network(best_lane_kernels(), weights.data()).predict(std::span(&point, 1), block);
    for (std::uint32_t i = 0; i < kVertexOutputs; ++i) {
        CHECK(alone[i] == in_lanes[i]);
        CHECK(alone[i] == block.outputs[i]);
    }
}

// The loss is half the sum of squares of the outputs. Central differences of a sum in float outputs: 1e-2 of the largest slope. Units
// whose sign changes within the step would be off, and are not among these weights.
TEST_CASE("The slopes of a network are those of its loss by finite differences") {
    std::vector<float> weights = random_values(kNetworkWeights, -0.3f, 0.3f, 11);
    std::vector<NetworkPoint> points;
    Uniforms random(12);
    for (int i = 0; i < 5; ++i)
        points.push_back({{random.next(), random.next(), random.next()}, square_to_sphere(random.square())});
    const auto loss = [&](const std::vector<float>& moved) {
        NetworkBlock block;
        Network(best_lane_kernels(), moved.data()).predict(points, block);
        double sum = 0.0;
        for (std::size_t i = 0; i < points.size() * kOutputColumns; ++i)
            sum += 0.5 * static_cast<double>(block.outputs[i]) * static_cast<double>(block.outputs[i]);
        return sum;
    };
    const Network network(best_lane_kernels(), weights.data());
    NetworkBlock block;
    network.predict(points, block);
    std::copy_n(block.outputs.begin(), points.size() * kOutputColumns, block.output_slopes.begin());
    std::vector<float> slopes(kNetworkWeights);
    network.propagate(block, slopes.data() + kFirstLayer);
    network.add_feature_slopes(points, block, slopes.data());
    const float largest = *std::max_element(slopes.begin(), slopes.end());
    REQUIRE(largest > 0.0f);
    int felt = 0;
    for (std::size_t i = 0; i < kNetworkWeights; i += i < kFirstLayer ? 53 : 7) {
        constexpr float kStep = 1.0f / 2048.0f;
        std::vector<float> moved = weights;
        moved[i] += kStep;
        const double above = loss(moved);
        moved[i] -= 2.0f * kStep;
        const double difference = (above - loss(moved)) / (2.0 * static_cast<double>(kStep));
        INFO("weight " << i << ", largest slope " << largest);
        CHECK(static_cast<double>(slopes[i]) == Approx(difference).margin(1e-2 * static_cast<double>(largest)));
        felt += std::fabs(slopes[i]) > 0.1f * largest ? 1 : 0;
    }
    CHECK(felt > 3);
}

// The loss here is of the mixture that is sampled, without the algebra of the slopes. Central differences in float densities.
TEST_CASE("The slopes of a mixture are those of its loss by finite differences") {
    const RandomLight random;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const std::vector<float> outputs = random_values(kVertexColumns, -1.5f, 1.5f, seed);
        std::vector<float> slopes(kVertexOutputs);
        const float loss = mixture_slopes(best_lane_kernels(), random.light(), outputs.data(), 1.0f, slopes.data());
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
        mixture_slopes(best_lane_kernels(), random.light(), outputs.data(), 1.0f, slopes.data());
        for (std::uint32_t k = 0; k < kVertexLobes; ++k)
            CHECK(slopes[kLobeNarrowness * kVertexLobes + k] * narrowness >= 0.0f);
    }
}

TEST_CASE("A fresh network guides nearly by the cosine, and knows nothing") {
    TestNeural neural;
    const NeuralField field = neural.view();
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
    const NeuralLocation location = field.locate(points_between()[0]);
    CHECK(location.is_served());
    CHECK(field.value_at(location) == 0.0f);
}

TEST_CASE("Densities of a neural field integrate to one at every point") {
    for (const int rounds : {0, 1, 8}) {
        TestNeural neural;
        neural.train(rounds);
        const NeuralField field = neural.view();
        for (const SurfacePoint& point : points_between()) {
            const NeuralLocation location = field.locate(point);
            CHECK(integral_over_sphere([&](Vec3f wi) { return field.density(location, point, wi).pdf_sa; }) ==
                  Approx(1.0).epsilon(2e-3));
        }
    }
}

// Rule S3, false alarms 1e-6: 400 000 samples in 256 equal parts of the sphere; a density off by 5 % from part to part would be found.
TEST_CASE("Directions of a neural field follow their density") {
    TestNeural neural;
    neural.train(8);
    std::uint64_t seed = 1;
    for (const SurfacePoint& point : points_between()) CHECK(samples_follow_density(neural.view(), point, seed++));
}

TEST_CASE("A network learns the light, also of volumes without training samples") {
    const auto divergence = [](int rounds, bool held_out) {
        TestNeural neural;
        neural.train(rounds);
        return neural.mean_divergence(held_out);
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

TEST_CASE("Threads change no bit of a network") {
    TestNeural one;
    one.train(3);
    CHECK(one.field.counts[kNetworkSteps] > 0);
    CHECK_FALSE(one.field.average == one.field.weights);
    for (const int threads : {2, 5}) {
        TestNeural other;
        other.train(3, threads);
        CHECK(same_field(one.field, other.field));
    }
}

TEST_CASE("A network learns nothing of darkness, and its tables are only read") {
    TestNeural dark;
    const TestNeural fresh;
    dark.field.pending_count[5] = 3;
    dark.update();
    CHECK(dark.field.counts[kNetworkSteps] == 0);
    CHECK(same_network(dark.field, fresh.field));
    TestNeural lit;
    lit.train(2);
    TestNeural tables;
    for (std::uint64_t round = 1; round <= 2; ++round) {
        tables.record(round);
        tables.update_tables();
    }
    CHECK(same_tables(lit.tables(), tables.tables()));
}

TEST_CASE("A table that is its uniform floor alone teaches nothing") {
    TestNeural neural;
    neural.shape.uniform_floor = 1.0f;
    neural.train(2);
    CHECK(neural.field.counts[kNetworkSteps] > 0);
    CHECK(neural.field.weights == TestNeural().field.weights);
}

// A volume without light must not pull at the weights of the others: a lit volume teaches the same network alone and among dark ones.
TEST_CASE("Dark volumes have no slope") {
    const auto network_after = [](bool visits_others) {
        TestNeural neural;
        const auto cells = static_cast<std::uint32_t>(neural.shape.cells.count());
        neural.field.pending_sum[7 * cells + 20] = to_fixed_point(4.0f, neural.shape.radiance_unit);
        neural.field.pending_count[7 * cells + 20] = 1;
        if (visits_others)
            for (std::uint32_t volume = 8; volume < 200; ++volume) neural.field.pending_count[volume * cells] = 50;
        neural.update();
        return neural.field;
    };
    const HostNeural alone = network_after(false);
    CHECK_FALSE(same_network(alone, TestNeural().field));
    CHECK(same_network(alone, network_after(true)));
}

TEST_CASE("A network that is not finite is given up, and paths are guided by the cosine") {
    for (const float damage : {kInfinity, kNan, 3e38f}) {
        TestNeural neural;
        neural.train(2);
        for (float& weight : neural.field.weights) weight = damage;
        neural.record(3);
        neural.update();
        CHECK(NeuralModel::network(neural.field).is_lost);
        CHECK_FALSE(damage_of(neural.field).has_value());
        CHECK(std::ranges::all_of(neural.field.average, [](float weight) { return std::isfinite(weight); }));
        const std::uint32_t steps = neural.field.counts[kNetworkSteps];
        neural.record(4);
        neural.update();
        CHECK(neural.field.counts[kNetworkSteps] == steps);
        const NeuralField field = neural.view();
        for (const SurfacePoint& point : points_between()) {
            const NeuralLocation location = field.locate(point);
            CHECK(location.mixture.lobes.weight[0] == 1.0f);
            CHECK(location.mixture.pdf_sa(point.shading_normal) == Approx(vmf_peak(kCosineKappa)));
            CHECK(field.value_at(location) > 0.0f);
            CHECK(samples_follow_density(field, point, 9));
        }
    }
}

TEST_CASE("Volumes of a neural field are divided and forgotten, the network stays") {
    TestNeural neural;
    neural.train(2);
    const FieldShape& shape = neural.shape;
    const std::vector<std::uint32_t> parents{1, 5};
    const HostNeural more = split_field(shape, neural.field, parents);
    CHECK(fits(shape, more, neural.count() + 2));
    CHECK_FALSE(fits(shape, more, neural.count()));
    CHECK(same_network(more, neural.field));
    CHECK(same_tables(more, split_field(shape, neural.tables(), parents)));
    HostField field = neural.field;
    forget_volume(shape, neural.volumes, field, 1);
    CHECK(std::get<HostNeural>(field).mean_radiance[1] == 0.0f);
    CHECK(same_network(std::get<HostNeural>(field), neural.field));
    HostNeural shorter = neural.field;
    shorter.average.pop_back();
    CHECK_FALSE(fits(shape, shorter, neural.count()));
}

TEST_CASE("The bytes of a neural field are those of its tables, its weights and their means") {
    TestNeural neural(8);
    CHECK(field_bytes(neural.field) == neural.count() * table_bytes(64) + kNetworkBytes);
}
