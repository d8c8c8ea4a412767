// The hierarchy's structure: complete, tight, shallow and deterministic, also for hard inputs.
#include "core/scene/build_bvh.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "core/base/error.h"
#include "core/base/host_array.h"
#include "core/scene/bvh_split.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

namespace {

struct Mesh {
    std::vector<Vec3f> positions;
    std::vector<Triangle> triangles;

    void add(Vec3f a, Vec3f b, Vec3f c) {
        const auto first = static_cast<std::uint32_t>(positions.size());
        positions.insert(positions.end(), {a, b, c});
        triangles.push_back({first, first + 1, first + 2, 0});
    }
    Bvh build(int threads = 1) const { return build_bvh(view_of(positions), view_of(triangles), threads); }
};

struct Shape {
    int depth = 0;  ///< of the deepest leaf; a root alone has 1
    std::uint32_t largest_leaf = 0;
    std::uint64_t inner_nodes = 0;
    std::uint64_t visited = 0;
    bool contained = true;  ///< every child lies in its parent, every triangle in its leaf
};

bool contains(const BvhNode& node, Vec3f p) {
    return p.x >= node.low.x && p.y >= node.low.y && p.z >= node.low.z && p.x <= node.high.x && p.y <= node.high.y &&
           p.z <= node.high.z;
}

Shape shape_of(const Mesh& mesh, const Bvh& bvh) {
    struct Visit {
        std::uint32_t node;
        int depth;
    };
    Shape shape;
    std::vector<Visit> stack;
    if (!bvh.nodes.empty()) stack.push_back({0, 1});
    while (!stack.empty()) {
        const Visit visit = stack.back();
        stack.pop_back();
        const BvhNode& node = bvh.nodes[visit.node];
        ++shape.visited;
        shape.depth = std::max(shape.depth, visit.depth);
        if (node.count == 0) {
            ++shape.inner_nodes;
            for (const std::uint32_t child : {node.first, node.first + 1}) {
                const BvhNode& c = bvh.nodes[child];
                shape.contained = shape.contained && contains(node, c.low) && contains(node, c.high);
                stack.push_back({child, visit.depth + 1});
            }
            continue;
        }
        shape.largest_leaf = std::max(shape.largest_leaf, node.count);
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const Triangle& t = mesh.triangles[bvh.primitives[i]];
            for (const std::uint32_t v : {t.v0, t.v1, t.v2})
                shape.contained = shape.contained && contains(node, mesh.positions[v]);
        }
    }
    return shape;
}

void check_sound(const Mesh& mesh) {
    const Bvh bvh = mesh.build();
    const Shape shape = shape_of(mesh, bvh);
    CHECK(shape.contained);
    CHECK(shape.depth <= kMaxBvhDepth);
    CHECK(shape.visited == bvh.nodes.size());
    CHECK(shape.largest_leaf <= 4);
    std::vector<std::uint32_t> sorted = bvh.primitives;
    std::sort(sorted.begin(), sorted.end());
    REQUIRE(sorted.size() == mesh.triangles.size());
    bool permutation = true;
    for (std::uint32_t i = 0; i < sorted.size(); ++i) permutation = permutation && sorted[i] == i;
    CHECK(permutation);
    for (const int threads : {2, 3, 0}) {
        const Bvh again = mesh.build(threads);
        CHECK(again.primitives == bvh.primitives);
        REQUIRE(again.nodes.size() == bvh.nodes.size());
        CHECK(std::memcmp(again.nodes.data(), bvh.nodes.data(), bvh.nodes.size() * sizeof(BvhNode)) == 0);
    }
}

/// The triangles of a mesh as a set to be split.
struct SetOfTriangles {
    std::vector<BuildTriangle> triangles;
    BuildBox centers;

    explicit SetOfTriangles(const Mesh& mesh) {
        for (const Triangle& t : mesh.triangles) {
            BuildBox box;
            for (const std::uint32_t v : {t.v0, t.v1, t.v2}) {
                const Vec3f p = mesh.positions[v];
                box.add(BuildVector{p.x, p.y, p.z, 0.0f});
            }
            triangles.emplace_back(box, static_cast<std::uint32_t>(triangles.size()));
            centers.add(triangles.back().center());
        }
    }

    BuildSplit split() const { return SplitFinder().find(triangles, Binning(centers)); }

    /// Of all splits between sixteen bins along the axes of space.
    double least_cost() const {
        double least = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            const float scale = 16.0f / (centers.high[axis] - centers.low[axis]);
            for (int last = 0; last < 15; ++last) {
                BuildBox sides[2];
                int counts[2] = {0, 0};
                for (const BuildTriangle& triangle : triangles) {
                    const auto bin = static_cast<int>((triangle.center()[axis] - centers.low[axis]) * scale);
                    const int side = bin <= last ? 0 : 1;
                    sides[side].add(triangle.box());
                    ++counts[side];
                }
                if (counts[0] > 0 && counts[1] > 0)
                    least = std::min(least, sides[0].half_area() * counts[0] + sides[1].half_area() * counts[1]);
            }
        }
        return least;
    }
};

Mesh random_mesh(int triangles) {
    Uniforms random(1);
    Mesh mesh;
    for (int i = 0; i < triangles; ++i) {
        const Vec3f p = random.cube(-1, 1);
        const Vec3f q = p + random.cube(-0.05f, 0.05f);
        mesh.add(p, q, p + random.cube(-0.05f, 0.05f));
    }
    return mesh;
}

Mesh all_at_one_place(int triangles) {
    Mesh mesh;
    for (int i = 0; i < triangles; ++i) mesh.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    return mesh;
}

/// Sizes and places 2^-i: the best split by area takes off one triangle at a time.
Mesh halving_sizes(int triangles) {
    Mesh mesh;
    for (int i = 0; i < triangles; ++i) {
        const float s = std::ldexp(1.0f, -(i % 120));
        mesh.add({s, 0, 0}, {s, s, 0}, {s, 0, s});
    }
    return mesh;
}

Mesh on_a_line(int triangles) {
    Mesh mesh;
    for (int i = 0; i < triangles; ++i) {
        const auto x = static_cast<float>(i);
        mesh.add({x, 0, 0}, {x + 1, 0, 0}, {x + 2, 0, 0});
    }
    return mesh;
}

Mesh spiral(int triangles) {
    Mesh mesh;
    for (int i = 0; i < triangles; ++i) {
        const double angle = 0.1 * i;
        const double radius = std::pow(1.01, i % 5000);
        const Vec3f p{Vec3d{radius * std::cos(angle), radius * std::sin(angle), radius}};
        mesh.add(p, 1.001f * p, p + Vec3f{0.01f * p.y, 0, 0.01f * p.x});
    }
    return mesh;
}

/// Each triangle is nested in the one before, so that no split separates their boxes.
Mesh nested(int triangles) {
    Mesh mesh;
    for (int i = 0; i < triangles; ++i) {
        const float s = 1.0f + static_cast<float>(i);
        mesh.add({-s, -s, -s}, {s, s, s}, {s, -s, 0.5f * s});
    }
    return mesh;
}

void check_hard_inputs(int triangles) {
    check_sound(random_mesh(triangles));
    check_sound(all_at_one_place(triangles));
    check_sound(halving_sizes(triangles));
    check_sound(on_a_line(triangles));
    check_sound(spiral(triangles));
    check_sound(nested(triangles));
}

}  // namespace

TEST_CASE("A hierarchy holds every triangle once") {
    for (const int triangles : {1, 2, 3, 4, 5, 8, 9, 100}) check_hard_inputs(triangles);
}

TEST_CASE("Hierarchies of 2e4 hard triangles stay shallow") { check_hard_inputs(20000); }

TEST_CASE("Hierarchies of 1e6 hard triangles stay shallow", "[nightly]") { check_hard_inputs(1000000); }

TEST_CASE("No triangles give no nodes") {
    const Bvh bvh = Mesh{}.build();
    CHECK(bvh.nodes.empty());
    CHECK(bvh.primitives.empty());
}

// Two distant clusters must end up under different children of the root, and empty space between them in neither.
TEST_CASE("The first split separates clusters") {
    Uniforms random(2);
    Mesh mesh;
    for (int i = 0; i < 200; ++i) {
        const Vec3f p = random.cube(-1, 1) + Vec3f{i % 2 == 0 ? -10.0f : 10.0f, 0, 0};
        mesh.add(p, p + Vec3f{0.1f, 0, 0}, p + Vec3f{0, 0.1f, 0});
    }
    const Bvh bvh = mesh.build();
    REQUIRE(bvh.nodes[0].count == 0);
    const BvhNode& left = bvh.nodes[bvh.nodes[0].first];
    const BvhNode& right = bvh.nodes[bvh.nodes[0].first + 1];
    CHECK(left.high.x < -8.0f);
    CHECK(right.low.x > 8.0f);
}

// Walls of a room have their centers among the things inside: no plane separates them.
TEST_CASE("A split by size separates large triangles from small ones among them") {
    Uniforms random(3);
    Mesh mesh;
    for (int i = 0; i < 1000; ++i) {
        const Vec3f p = random.cube(-1, 1);
        mesh.add(p, p + Vec3f{0.1f, 0, 0}, p + Vec3f{0, 0.1f, 0});
    }
    for (const float side : {-5.0f, 5.0f}) {
        mesh.add({side, -5, -5}, {side, 5, 5}, {side, 5, -5});
        mesh.add({-5, side, -5}, {5, side, 5}, {5, side, -5});
        mesh.add({-5, -5, side}, {5, 5, side}, {5, -5, side});
    }
    const BuildSplit split = SetOfTriangles(mesh).split();
    CHECK(split.axis == kSizeAxis);
    CHECK(split.lower == 1000);
}

TEST_CASE("A split is the cheapest between sixteen bins along each axis") {
    for (const int triangles : {2, 10, 3000}) {
        const SetOfTriangles set(random_mesh(triangles));
        CHECK(set.split().cost <= set.least_cost() * (1.0 + 1e-12));
    }
}

TEST_CASE("More triangles than references can number are refused before any is read") {
    CHECK_THROWS_AS(build_bvh({}, Span<const Triangle>{nullptr, kMaxBvhTriangles + 1}), Error);
}
