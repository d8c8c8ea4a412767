// The SD-tree: its densities, its samples, the order of its sums, its bounds, and refusal of damaged trees.
#include "core/fields/sd_tree_model.h"

#include <algorithm>
#include <functional>

#include "core/fields/field_model.h"
#include "tests/support/catch.hpp"
#include "tests/support/field/sd_tree_fixture.h"
#include "tests/support/statistics/sampling_rule.h"

using namespace pl;
using namespace pl::test;

namespace {

/// Calls visit(low corner, slot) for the slots of a leaf, found as lookups find them.
void for_each_slot(const SdTreeView& field, std::uint32_t leaf, const std::function<void(Vec2f, QuadSlot)>& visit) {
    const std::function<void(Vec2f, float)> descend = [&](Vec2f low, float side) {
        const QuadSlot slot = field.slot_at(leaf, low + 0.25f * side);
        // The slot that holds the point is no larger than the square, or is the square that was asked for.
        if (slot.side() >= side) return visit(low, slot);
        for (int quadrant = 0; quadrant < 4; ++quadrant)
            descend(low + 0.5f * side * Vec2f{quadrant % 2, quadrant / 2}, 0.5f * side);
    };
    descend({0.0f, 0.0f}, 1.0f);
}

double integral_over_sphere(const SdTreeView& field, std::uint32_t leaf) {
    double sum = 0.0;
    for_each_slot(field, leaf, [&](Vec2f, QuadSlot slot) {
        const double area = static_cast<double>(slot.side()) * slot.side();
        sum += area * static_cast<double>(field.slot_pdf_sa(leaf, slot)) / static_cast<double>(kUniformSpherePdf);
    });
    return sum;
}

std::uint64_t sum(const LargeArray<std::uint32_t>& values) {
    std::uint64_t total = 0;
    for (const std::uint32_t value : values) total += value;
    return total;
}

}  // namespace

TEST_CASE("The map between square and sphere is its own inverse and keeps areas") {
    Uniforms random(1);
    for (int i = 0; i < 10000; ++i) {
        const Vec2f square = random.square();
        const Vec3f direction = square_to_sphere(square);
        CHECK(std::fabs(glm::length(direction) - 1.0f) < 1e-6f);
        const Vec2f back = sphere_to_square(direction);
        const float turn = std::fabs(back.y - square.y);
        CHECK(std::fabs(back.x - square.x) < 1e-6f);
        // Close to the poles the azimuth is known less well.
        const float radius = std::sqrt(square.x * (1.0f - square.x));
        CHECK(std::min(turn, 1.0f - turn) * radius < 1e-6f);
    }
    for (const Vec3f pole : {Vec3f{0, 0, 1}, Vec3f{0, 0, -1}, Vec3f{-1, 0, 0}, Vec3f{-1, -0.0f, 0}}) {
        const Vec2f square = sphere_to_square(pole);
        CHECK((square.x >= 0.0f && square.x < 1.0f && square.y >= 0.0f && square.y < 1.0f));
    }
}

// Rounding: sums of some hundred slots.
TEST_CASE("Densities of an SD-tree integrate to one, before and after training") {
    TestTree untrained;
    CHECK(integral_over_sphere(untrained.view(), 0) == Approx(1.0).epsilon(1e-12));
    for (const int rounds : {1, 4}) {
        TestTree tree = trained_tree(1, rounds);
        const SdTreeField field = tree.view();
        REQUIRE(tree.leaves() >= 16);
        for (std::uint32_t leaf = 0; leaf < tree.leaves(); ++leaf)
            REQUIRE(std::fabs(integral_over_sphere(field, leaf) - 1.0) < 1e-5);
    }
}

// Rule S3, false alarms 1e-6: 400 000 samples of one leaf, in its slots and in their quarters; a density off by 5 % of the
// root mean square from slot to slot would be found.
TEST_CASE("Samples of an SD-tree follow its density") {
    TestTree tree = trained_tree();
    const SdTreeField field = tree.view();
    const SdTreeLocation location = field.locate(TestTree::point_at({0.3f, -0.2f, 0.4f}));
    const std::uint32_t leaf = location.leaf.leaf;
    std::vector<std::size_t> first_bin(tree.tree.energy.size(), 0);
    std::vector<double> probabilities;
    for_each_slot(field, leaf, [&](Vec2f, QuadSlot slot) {
        first_bin[slot.slot] = probabilities.size();
        const double area = static_cast<double>(slot.side()) * slot.side();
        const double p = area * static_cast<double>(field.slot_pdf_sa(leaf, slot) / kUniformSpherePdf);
        probabilities.insert(probabilities.end(), 4, 0.25 * p);
    });
    REQUIRE(probabilities.size() > 60);
    std::vector<std::uint64_t> counts(probabilities.size(), 0);
    Uniforms random(2);
    for (int i = 0; i < 400000; ++i) {
        ScatterUniforms numbers;
        numbers.u = {0.0f, random.next(), random.next(), 0.0f};
        const Vec3f wi = field.sample(location, {}, numbers);
        const FieldDensity density = field.density(location, {}, wi);
        REQUIRE(density.pdf_sa > 0.0f);
        const Vec2f square = sphere_to_square(wi);
        const QuadSlot slot = field.slot_at(leaf, square);
        const float quarters = 2.0f / slot.side();
        const auto column = static_cast<std::size_t>(square.x * quarters) % 2;
        const auto row = static_cast<std::size_t>(square.y * quarters) % 2;
        ++counts[first_bin[slot.slot] + 2 * row + column];
    }
    CHECK(sampler_matches(counts, probabilities, 0.05));
}

TEST_CASE("Training brings the density of an SD-tree to the light") {
    TestTree tree = trained_tree();
    const SdTreeField field = tree.view();
    const Vec3f position{0.5f, 0.5f, -0.5f};
    const SdTreeLocation location = field.locate(TestTree::point_at(position));
    const Vec3f peak = glm::normalize(Vec3f{0.2f, 0.1f, 1.5f} - position);
    // The light has 0.9 of its energy within 37 degrees of its peak, uniform directions a tenth.
    Uniforms random(5);
    int near_peak = 0;
    for (int i = 0; i < 10000; ++i) {
        ScatterUniforms numbers;
        numbers.u = {0.0f, random.next(), random.next(), 0.0f};
        near_peak += glm::dot(field.sample(location, {}, numbers), peak) > 0.8f ? 1 : 0;
    }
    CHECK(near_peak > 6000);
    CHECK(field.density(location, {}, -peak).pdf_sa < 0.2f * kUniformSpherePdf);
    // The integral of the light over the sphere, and the mean of its slots.
    CHECK(field.total_energy(location.leaf.leaf) ==
          Approx(0.05f * 4.0f * kPi + 20.0f * 2.0f * kPi / 21.0f).epsilon(0.3));
    CHECK(field.radiance_at(location, field.density(location, {}, -peak).bin) == Approx(0.05f).epsilon(0.3));
    CHECK(field.radiance_at(location, -1) == field.value_at(location));
}

TEST_CASE("Neither the order of training samples nor threads change a bit of an SD-tree") {
    TestTree forward = trained_tree(1, 2);
    TestTree backward = trained_tree(1, 2);
    std::vector<HandSample> samples = hand_samples(5000, 9);
    for (const HandSample& sample : samples) forward.record(sample);
    std::ranges::reverse(samples);
    for (const HandSample& sample : samples) backward.record(sample);
    CHECK(forward == backward);
    forward.update(1);
    backward.update(8);
    CHECK(forward == backward);
    CHECK(trained_tree(1) == trained_tree(3));
    CHECK_FALSE(trained_tree(1, 2) == forward);
}

TEST_CASE("An SD-tree splits leaves by their training samples, and loses none") {
    TestTree tree;
    for (const HandSample& sample : hand_samples(20000, 1)) tree.record(sample);
    tree.update();
    CHECK(sum(tree.tree.visits) == 20000);
    for (const std::uint32_t visits : tree.tree.visits) CHECK(visits <= kFewestSplitSamples + 1);
    CHECK(tree.leaves() == 16);  // 20 000 samples of one leaf are halved four times
    CHECK(tree.tree.spatial.size() == 2 * std::size_t{tree.leaves()} - 1);
    // Points of one leaf are in one cell of the division of x by four, y and z by two.
    const SdTreeField field = tree.view();
    CHECK(field.leaf_at({0.1f, 0.1f, 0.1f}).leaf == field.leaf_at({0.2f, 0.2f, 0.2f}).leaf);
    CHECK(field.leaf_at({0.1f, 0.1f, 0.1f}).leaf != field.leaf_at({0.3f, 0.1f, 0.1f}).leaf);
    CHECK(field.leaf_at({0.1f, 0.1f, 0.1f}).depth == 4);
}

TEST_CASE("An SD-tree divides quadrants by their share of the energy, and joins those that lost it") {
    TestTree tree;
    Uniforms random(3);
    const auto train = [&](Vec3f bright) {
        for (int i = 0; i < 20000; ++i) {
            const Vec3f wi = square_to_sphere(random.square());
            tree.record({{0.1f, 0.1f, 0.1f}, wi, kUniformSpherePdf, glm::dot(wi, bright) > 0.98f ? 1.0f : 0.01f});
        }
        tree.update();
    };
    for (int i = 0; i < 3; ++i) train({0.0f, 0.6f, 0.8f});
    const auto slot_towards = [&](Vec3f wi) {
        const SdTreeField field = tree.view();
        const std::uint32_t leaf = field.locate(TestTree::point_at({0.1f, 0.1f, 0.1f})).leaf.leaf;
        const QuadSlot slot = field.slot_at(leaf, sphere_to_square(wi));
        const float few = kFewestInQuadrant / static_cast<float>(field.visits[leaf]);
        CHECK(field.energy[slot.slot] <= 1.01f * max_of(kDividedShare, few) * field.total_energy(leaf));
        return slot;
    };
    CHECK(slot_towards({0.0f, 0.6f, 0.8f}).depth >= slot_towards({0.0f, -0.6f, -0.8f}).depth + 2);
    const std::uint32_t sharp = slot_towards({0.0f, 0.6f, 0.8f}).depth;
    for (int i = 0; i < 60; ++i) train({0.0f, -0.6f, -0.8f});
    CHECK(slot_towards({0.0f, 0.6f, 0.8f}).depth < sharp);
    CHECK(slot_towards({0.0f, -0.6f, -0.8f}).depth > slot_towards({0.0f, 0.6f, 0.8f}).depth);
}

TEST_CASE("An SD-tree keeps its bound of nodes") {
    for (const std::uint32_t most : {64u, 200u, 500u}) {
        TestTree tree;
        tree.shape.most_nodes = most;
        for (int round = 0; round < 3; ++round) {
            for (const HandSample& sample : hand_samples(20000, static_cast<std::uint64_t>(round)))
                tree.record(sample);
            tree.update();
            CHECK(tree.nodes() <= most);
            CHECK(fits(tree.shape, tree.tree, 1));
            CHECK_FALSE(damage_of(tree.tree).has_value());
        }
        CHECK(tree.nodes() > most / 8);
        CHECK(field_bytes(tree.tree) <=
              most * SdTreeModel::bytes_of_node() + bytes_by_volume<HostSdTree>(tree.shape));
    }
}

// Directions of any density: the mean is weighted by cos / (pi q), so radiance that is the same everywhere is met but for rounding.
TEST_CASE("The irradiance of a volume is the cosine-weighted mean of its training samples") {
    TestTree tree;
    Uniforms random(4);
    for (int i = 0; i < 1000; ++i) {
        const Vec3f wi = square_to_sphere({0.5f + 0.5f * random.next(), random.next()});
        tree.record({random.cube(-1.0f, 1.0f), wi, random.between(0.1f, 2.0f), 3.0f});
    }
    tree.update();
    CHECK(tree.tree.mean_radiance[0] == Approx(3.0f).epsilon(1e-5));
    CHECK(tree.tree.samples[0] == 1000);
    CHECK(tree.tree.change[0] == tree.tree.mean_radiance[0]);
}

TEST_CASE("A volume of an SD-tree is forgotten with the directions of its leaf, and nothing else") {
    TestTree tree = trained_tree();
    const std::uint32_t leaf = tree.view().locate(TestTree::point_at({0.0f, 0.0f, 0.0f})).leaf.leaf;
    const std::uint64_t visits = sum(tree.tree.visits) - tree.tree.visits[leaf];
    HostField field = tree.tree;
    forget_volume(tree.shape, tree.volumes, field, 0);
    tree.tree = std::get<HostSdTree>(field);
    CHECK(tree.view().total_energy(leaf) == 0.0f);
    CHECK(tree.tree.mean_radiance[0] == 0.0f);
    CHECK(sum(tree.tree.visits) == visits);
    CHECK(integral_over_sphere(tree.view(), leaf) == Approx(1.0).epsilon(1e-6));
    tree.update();
    CHECK_FALSE(damage_of(tree.tree).has_value());
}

TEST_CASE("Damaged SD-trees are found") {
    const TestTree whole = trained_tree(1, 1);
    REQUIRE_FALSE(damage_of(whole.tree).has_value());
    const auto is_found = [&](const std::function<void(HostSdTree&)>& damage) {
        HostSdTree tree = whole.tree;
        damage(tree);
        return !fits(whole.shape, tree, 1) || damage_of(tree).has_value();
    };
    CHECK(is_found([](HostSdTree& t) { t.spatial[0] = 0; }));
    CHECK(is_found([](HostSdTree& t) { t.spatial[0] = 2; }));
    CHECK(is_found([](HostSdTree& t) { t.spatial.back() = static_cast<std::uint32_t>(t.spatial.size()) - 1; }));
    CHECK(is_found([](HostSdTree& t) { t.spatial.back() = SpatialNode::kIsLeaf | 0x7fffffffu; }));
    CHECK(is_found([](HostSdTree& t) {
        t.spatial.back() =
            *std::ranges::find_if(t.spatial, [](std::uint32_t word) { return (word & SpatialNode::kIsLeaf) != 0; });
    }));
    CHECK(is_found([](HostSdTree& t) { t.first_node[0] = 1; }));
    CHECK(is_found([](HostSdTree& t) { t.first_node[1] = t.first_node[2]; }));
    CHECK(is_found([](HostSdTree& t) { t.first_node.back() = static_cast<std::uint32_t>(t.energy.size()); }));
    CHECK(is_found([](HostSdTree& t) { t.child[0] = 0x10000000u; }));
    CHECK(is_found([](HostSdTree& t) { *std::ranges::find_if(t.child, [](std::uint32_t c) { return c > 0; }) = 0; }));
    CHECK(is_found([](HostSdTree& t) { t.energy[0] += 1.0f; }));
    CHECK(is_found([](HostSdTree& t) { t.energy.pop_back(); }));
    CHECK(is_found([](HostSdTree& t) { t.visits.pop_back(); }));
    CHECK(is_found([](HostSdTree& t) { t.mean_radiance.clear(); }));
    CHECK(is_found([](HostSdTree& t) { t = {}; }));
}
