// Neural fields: the slopes of the network, the same bits for all instruction sets and threads, what is learned of neighbors, and
// a network that is given up.
#include <algorithm>
#include <functional>

#include "core/fields/reset_tables.h"
#include "cpu/neural_network.h"
#include "tests/support/catch.hpp"
#include "tests/support/field/neural_fixture.h"
#include "tests/support/field/random_tables.h"
#include "tests/support/scenes/random_values.h"
#include "tests/support/statistics/sampling_rule.h"

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

bool same_bits_of_network(const HostNeural& a, const HostNeural& b) {
    bool same = true;
    for_each_network_array([&](const auto& spec) { same = same && spec.get(a) == spec.get(b); });
    return same;
}

/// Cells of a volume with some visits and radiance, and logarithms that a network may predict.
struct RandomLight {
    std::vector<float> visits, radiance, is_cell, logarithms;
    std::uint32_t columns;

    explicit RandomLight(std::uint32_t cells, std::uint64_t seed) : columns(NetworkLayout(cells).columns) {
        Uniforms random(seed);
        visits.resize(columns);
        radiance.resize(columns);
        is_cell.resize(columns);
        for (std::uint32_t cell = 0; cell < cells; ++cell) {
            is_cell[cell] = 1.0f;
            visits[cell] = static_cast<float>(random.below(3) == 0 ? random.below(200) : 0u);
            radiance[cell] = visits[cell] > 0.0f ? random.between(0.0f, 5.0f) : 0.0f;
        }
        logarithms = random_values(columns, -6.0f, 6.0f, seed + 1);
    }
    VolumeLight light() const { return {visits.data(), radiance.data(), is_cell.data(), logarithms.data(), columns}; }
};

/// All that the kernels of one instruction set compute of random numbers.
std::vector<float> results_of(const NeuralKernels& kernels, std::uint32_t side) {
    const RandomLight random(side * side, side);
    const std::uint32_t columns = random.columns;
    std::vector<float> all;
    const auto keep = [&](const std::vector<float>& values) { all.insert(all.end(), values.begin(), values.end()); };
    std::vector<float> slopes(columns), predicted(columns), weights(std::size_t{side} * side);
    all.push_back(kernels.slopes(random.light(), 0.1f, slopes.data()));
    CHECK(kernels.predict(random.light(), predicted.data()));
    kernels.weigh(random.light(), predicted.data(), side, weights.data());
    keep(slopes);
    keep(predicted);
    keep(weights);
    std::vector<float> weight = random_values(columns, -1.0f, 1.0f, 3);
    std::vector<float> mean = random_values(columns, -1.0f, 1.0f, 4);
    std::vector<float> square = random_values(columns, 0.0f, 1.0f, 5);
    kernels.descend({weight.data(), mean.data(), square.data(), slopes.data(), columns, 0.01f, 1.5f});
    keep(weight);
    keep(mean);
    keep(square);
    const std::vector<float> a = random_values(8 * 20, -1.0f, 1.0f, 6);
    const std::vector<float> b = random_values(20 * std::size_t{columns}, -1.0f, 1.0f, 7);
    std::vector<float> c(8 * std::size_t{columns}, 0.5f);
    for (const bool adds : {false, true})
        kernels.multiply({a.data(), 20, 1, b.data(), columns, c.data(), columns, 8, 20, columns, adds});
    keep(c);
    return all;
}

/// Loss of a network at points, in double precision from the logarithms on.
class NetworkLoss {
public:
    NetworkLoss(const NetworkLayout& layout, std::span<const NetworkPoint> points,
                const std::vector<RandomLight>& lights)
        : layout_(layout), points_(points), lights_(lights) {}
    double operator()(const std::vector<float>& weights) const {
        const std::vector<double> predicted = logarithms(weights);
        double loss = 0.0;
        for (std::size_t i = 0; i < points_.size(); ++i)
            for (std::uint32_t cell = 0; cell < kCells; ++cell) {
                const double logarithm = predicted[i * kCells + cell];
                const double visits = std::min(static_cast<double>(lights_[i].visits[cell]), 64.0);
                loss += visits * (std::exp(logarithm) - static_cast<double>(lights_[i].radiance[cell]) * logarithm);
            }
        return loss;
    }
    static constexpr std::uint32_t kCells = 16;

private:
    std::vector<double> logarithms(const std::vector<float>& weights) const {
        NetworkBlock block(layout_);
        Network(best_neural_kernels(), layout_, weights.data()).predict(points_, block);
        std::vector<double> values;
        for (std::size_t i = 0; i < points_.size(); ++i)
            for (std::uint32_t cell = 0; cell < kCells; ++cell)
                values.push_back(static_cast<double>(block.outputs[i * layout_.columns + cell]));
        return values;
    }
    const NetworkLayout& layout_;
    std::span<const NetworkPoint> points_;
    const std::vector<RandomLight>& lights_;
};

}  // namespace

TEST_CASE("Every instruction set computes the same bits of a network") {
    for (const std::uint32_t side : {2u, 6u, 16u, 17u, 32u}) {
        const std::vector<float> expected = results_of(usable_neural_kernels().front(), side);
        for (const NeuralKernels& kernels : usable_neural_kernels()) {
            INFO(kernels.isa << ", side " << side);
            CHECK(results_of(kernels, side) == expected);
        }
    }
}

TEST_CASE("A network that predicts by exponents is off by rounding alone") {
    std::vector<float> ones(32, 1.0f), none(32, 0.0f), exponents(32), predicted(32);
    for (int i = 0; i < 32; ++i) exponents[static_cast<std::size_t>(i)] = -19.0f + 1.21f * static_cast<float>(i);
    const VolumeLight light{none.data(), none.data(), ones.data(), exponents.data(), 32};
    REQUIRE(best_neural_kernels().predict(light, predicted.data()));
    for (std::size_t i = 0; i < 32; ++i) {
        const double exact = std::exp(static_cast<double>(exponents[i]));
        CHECK(static_cast<double>(predicted[i]) == Approx(exact).epsilon(3e-6));
    }
}

// Central differences of a sum in float logarithms: 1e-2 of the largest slope. Units whose sign changes within the step would
// be off, and are not among these weights.
TEST_CASE("The slopes of the network are those of its loss by finite differences") {
    const NetworkLayout layout(NetworkLoss::kCells);
    std::vector<float> weights = random_values(layout.count, -0.4f, 0.4f, 11);
    std::vector<NetworkPoint> points;
    std::vector<RandomLight> lights;
    Uniforms random(12);
    for (std::uint64_t i = 0; i < 5; ++i) {
        points.push_back({{random.next(), random.next(), random.next()}, square_to_sphere(random.square())});
        lights.emplace_back(NetworkLoss::kCells, 20 + i);
    }
    const Network network(best_neural_kernels(), layout, weights.data());
    NetworkBlock block(layout);
    network.predict(points, block);
    for (std::size_t i = 0; i < points.size(); ++i) {
        VolumeLight light = lights[i].light();
        light.logarithms = block.outputs.data() + i * layout.columns;
        best_neural_kernels().slopes(light, 1.0f, block.output_slopes.data() + i * layout.columns);
    }
    std::vector<float> slopes(layout.count);
    network.propagate(block, slopes.data() + layout.first);
    network.add_feature_slopes(points, block, slopes.data());
    const NetworkLoss loss(layout, points, lights);
    const float largest = *std::max_element(slopes.begin(), slopes.end());
    REQUIRE(largest > 0.0f);
    int felt = 0;
    for (std::size_t i = 0; i < layout.count; i += i < layout.first ? 53 : 7) {
        constexpr float kStep = 1.0f / 512.0f;
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

// Without training samples of their own, and with a dozen in 256 cells. The divergence of cosine sampling is that of volumes
// held out of a table.
TEST_CASE("A network knows the light of volumes without training samples, and adds to that of the others") {
    TestNeural neural;
    TestNeural tables;
    const double uniform = tables.mean_divergence(true);
    neural.train(6);
    for (int round = 1; round <= 6; ++round) {
        tables.record(static_cast<std::uint64_t>(round));
        tables.update_tables();
    }
    INFO("uniform " << uniform << ", tables " << tables.mean_divergence(false) << ", neural "
                    << neural.mean_divergence(false) << ", held out " << neural.mean_divergence(true));
    CHECK(tables.mean_divergence(true) == Approx(uniform).epsilon(1e-4));
    CHECK(neural.mean_divergence(true) < 0.5 * uniform);
    CHECK(neural.mean_divergence(false) < 0.8 * tables.mean_divergence(false));
}

TEST_CASE("What the tables have learned is theirs alone") {
    TestNeural neural;
    TestNeural tables;
    neural.train(3);
    for (int round = 1; round <= 3; ++round) {
        tables.record(static_cast<std::uint64_t>(round));
        tables.update_tables();
    }
    CHECK_FALSE(same_tables(neural.tables(), tables.tables()));
    neural.field.row_cdf = tables.field.row_cdf;
    neural.field.column_cdf = tables.field.column_cdf;
    CHECK(same_tables(neural.tables(), tables.tables()));
}

TEST_CASE("Threads change no bit of a neural field") {
    TestNeural one;
    one.train(3);
    CHECK(one.field.counts[kNetworkSteps] > 0);
    for (const int threads : {2, 5}) {
        TestNeural other;
        other.train(3, threads);
        CHECK(same_field(one.field, other.field));
    }
}

// Rule S3: 400 000 samples of each of three volumes, one of them without training samples of its own.
TEST_CASE("Directions of a neural field follow their density, which integrates to one") {
    TestNeural neural;
    neural.train(4);
    for (const std::int32_t volume : {3, 40, 301}) {
        const DirectionTable table(neural.view(), volume);
        const int side = table.cells.side;
        std::vector<double> probabilities;
        double sum = 0.0;
        for (int cell = 0; cell < table.cells.count(); ++cell) {
            probabilities.push_back(static_cast<double>(table.cell_probability(cell % side, cell / side)));
            CHECK(probabilities.back() >= 0.09 / table.cells.count());
            sum += probabilities.back();
        }
        CHECK(sum == Approx(1.0).epsilon(1e-5));
        std::vector<std::uint64_t> counts(probabilities.size());
        Uniforms random(static_cast<std::uint64_t>(volume));
        for (int i = 0; i < 400000; ++i) {
            const Vec2f u = random.square();
            const CellNumber<One> cell = sample_cell(table, sample_row(table, u.y), u.x);
            ++counts[static_cast<std::size_t>(cell.row * side + cell.column)];
        }
        CHECK(sampler_matches(counts, probabilities, 0.05));
    }
}

TEST_CASE("A network learns nothing of darkness") {
    TestNeural neural;
    const TestNeural fresh;
    neural.field.pending_count[5] = 3;
    neural.update();
    CHECK(neural.field.counts[kNetworkSteps] == 0);
    CHECK(same_bits_of_network(neural.field, fresh.field));
    CHECK(neural.divergence(0) == TestNeural().divergence(0));
}

TEST_CASE("A network that is not finite is given up, and the tables are sampled without it") {
    for (const float damage : {kInfinity, kNan, 3e38f}) {
        TestNeural neural;
        neural.train(2);
        for (float& weight : neural.field.weights) weight = damage;
        neural.record(3);
        neural.update();
        CHECK(status_of(neural.field).is_lost);
        CHECK_FALSE(damage_of(neural.field).has_value());
        CHECK(std::ranges::all_of(neural.field.weights, [](float weight) { return std::isfinite(weight); }));
        neural.record(4);
        neural.update();
        TestNeural tables;
        for (int round = 1; round <= 4; ++round) {
            tables.record(static_cast<std::uint64_t>(round));
            tables.update_tables();
        }
        CHECK(same_tables(neural.tables(), tables.tables()));
    }
}

TEST_CASE("Volumes of a neural field are divided and forgotten, the network stays") {
    TestNeural neural;
    neural.train(2);
    const std::vector<std::uint32_t> parents{1, 5};
    const HostNeural more = split_field(neural.shape, neural.field, parents);
    CHECK(fits(neural.shape, more, neural.count() + 2));
    CHECK_FALSE(fits(neural.shape, more, neural.count()));
    CHECK(same_bits_of_network(more, neural.field));
    CHECK(same_tables(more, split_field(neural.shape, neural.tables(), parents)));
    HostField field = neural.field;
    forget_volume(neural.shape, neural.volumes, field, 1);
    const HostNeural& forgetful = std::get<HostNeural>(field);
    CHECK(forgetful.mean_radiance[1] == 0.0f);
    CHECK(same_bits_of_network(forgetful, neural.field));
}

TEST_CASE("The bytes of a neural field are those of its tables and of its network") {
    TestNeural neural(8);
    CHECK(field_bytes(neural.field) == neural.count() * table_bytes(64) + network_bytes(64));
    CHECK(status_of(neural.field).bytes == network_bytes(64));
}
