// Subtrees of a hierarchy move to where they cost less.
#include "core/scene/reinsert_bvh.h"

#include <algorithm>

#include "core/scene/bvh_split.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

namespace {

BvhNode leaf(Vec3f low, Vec3f high, std::uint32_t triangle) {
    return {.low = low, .first = triangle, .high = high, .count = 1};
}
BvhNode inner(const BvhNode& a, const BvhNode& b, std::uint32_t first) {
    return {.low = glm::min(a.low, b.low), .first = first, .high = glm::max(a.high, b.high), .count = 0};
}

/// The sum of the areas of all nodes.
double cost_of(const Bvh& bvh) {
    double cost = 0.0;
    for (const BvhNode& node : bvh.nodes) cost += half_area(Vec3d{node.high} - Vec3d{node.low});
    return cost;
}

/// Appends a chain below `root`: each of its inner nodes has one leaf and the next inner node.
void set_chain(Bvh& bvh, std::uint32_t root, const std::vector<BvhNode>& leaves) {
    const auto first = static_cast<std::uint32_t>(bvh.nodes.size());
    const auto inner_nodes = static_cast<std::uint32_t>(leaves.size() - 1);
    bvh.nodes.resize(first + 2 * inner_nodes);
    BvhNode below = leaves.back();
    for (std::uint32_t i = inner_nodes; i-- > 0;) {
        bvh.nodes[first + 2 * i] = leaves[i];
        bvh.nodes[first + 2 * i + 1] = below;
        below = inner(leaves[i], below, first + 2 * i);
    }
    bvh.nodes[root] = below;
}

int depth_below(const Bvh& bvh, std::uint32_t node) {
    if (bvh.nodes[node].count > 0) return 1;
    const std::uint32_t first = bvh.nodes[node].first;
    return 1 + std::max(depth_below(bvh, first), depth_below(bvh, first + 1));
}

}  // namespace

// Two pairs of neighbors, each divided between both children of the root.
TEST_CASE("Leaves move beside their neighbors") {
    const BvhNode a0 = leaf({0, 0, 0}, {1, 1, 1}, 0), a1 = leaf({1, 0, 0}, {2, 1, 1}, 1);
    const BvhNode b0 = leaf({90, 0, 0}, {91, 1, 1}, 2), b1 = leaf({91, 0, 0}, {92, 1, 1}, 3);
    Bvh bvh;
    bvh.primitives = {7, 5, 6, 4};
    bvh.nodes = {inner(inner(a0, b0, 3), inner(a1, b1, 5), 1), inner(a0, b0, 3), inner(a1, b1, 5), a0, b0, a1, b1};
    reinsert_nodes(bvh);
    REQUIRE(bvh.nodes.size() == 7);
    // Each pair has a half area of 5, each leaf 3, the root 185.
    CHECK(cost_of(bvh) == 185.0 + 2 * 5.0 + 4 * 3.0);
    for (const std::uint32_t child : {1u, 2u}) {
        const BvhNode& pair = bvh.nodes[child];
        REQUIRE(pair.count == 0);
        for (const std::uint32_t i : {pair.first, pair.first + 1}) {
            const std::uint32_t triangle = bvh.primitives[bvh.nodes[i].first];
            CHECK((triangle == 7 || triangle == 5) == (bvh.nodes[i].low.x < 50.0f));
        }
    }
}

// Two chains of 40 leaves. The one of smaller boxes is best at the end of the other, at the smallest leaf.
TEST_CASE("No move makes a hierarchy too deep") {
    constexpr std::uint32_t kChain = 40;
    std::vector<BvhNode> large(kChain, leaf({0, 0, 0}, {10, 10, 10}, 0));
    large.back() = leaf({0, 0, 0}, {1, 1, 1}, 0);
    const std::vector<BvhNode> small(kChain, leaf({0, 0, 0}, {2, 2, 2}, 0));
    Bvh bvh;
    bvh.primitives = {0};  // all leaves share it
    bvh.nodes.resize(3);
    set_chain(bvh, 1, large);
    set_chain(bvh, 2, small);
    bvh.nodes[0] = inner(bvh.nodes[1], bvh.nodes[2], 1);
    const double before = cost_of(bvh);
    reinsert_nodes(bvh);
    CHECK(depth_below(bvh, 0) < kMaxBvhDepth);
    CHECK(cost_of(bvh) < before);
}

TEST_CASE("A chain of leaves at random places becomes a tree") {
    constexpr std::uint32_t kLeaves = 50;
    Uniforms random(5);
    std::vector<BvhNode> leaves;
    Bvh bvh;
    bvh.nodes.resize(1);
    for (std::uint32_t i = 0; i < kLeaves; ++i) {
        const Vec3f p = random.cube(-1, 1);
        leaves.push_back(leaf(p, p + Vec3f{0.01f}, i));
        bvh.primitives.push_back(i);
    }
    set_chain(bvh, 0, leaves);
    const double before = cost_of(bvh);
    reinsert_nodes(bvh);
    CHECK(cost_of(bvh) < 0.5 * before);
    CHECK(depth_below(bvh, 0) < 20);
    // Depth first, triangles too.
    std::uint32_t triangles = 0, pairs = 0;
    std::vector<std::uint32_t> waiting{0};
    while (!waiting.empty()) {
        const BvhNode& node = bvh.nodes[waiting.back()];
        waiting.pop_back();
        if (node.count > 0) {
            CHECK(node.first == triangles);
            triangles += node.count;
        } else {
            CHECK(node.first == 1 + 2 * pairs++);
            waiting.push_back(node.first + 1);
            waiting.push_back(node.first);
        }
    }
    CHECK(triangles == kLeaves);
    CHECK(pairs == kLeaves - 1);
}
