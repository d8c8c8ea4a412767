// The lookup of a volume: the tree gives the result of a linear search and of nanoflann, for every kind of input.
#include <algorithm>
#include <functional>
#include <memory>

#include "core/fields/place_volumes.h"
#include "tests/core/fields/nanoflann_index.h"
#include "tests/support/catch.hpp"
#include "tests/support/field/linear_search.h"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

namespace {

SurfacePoint site(Vec3f position, Vec3f normal = {0, 0, 1}) {
    SurfacePoint point;
    point.position = position;
    point.geometric_normal = normal;
    return point;
}

Sites make_sites(int count, const std::function<Vec3f(int)>& position) {
    Sites sites;
    for (int i = 0; i < count; ++i) sites.push_back(site(position(i)));
    return sites;
}

std::vector<KdNode> tree_of(const Sites& sites) { return build_kd_tree(view_of(sites)); }

KdTreeView view(const std::vector<KdNode>& nodes) { return {view_of(nodes)}; }

/// Linear search over the sites themselves, independent of the tree and its order.
Nearest search_sites(const Sites& sites, Vec3f position, Vec3f normal) {
    Nearest nearest;
    for (std::uint32_t i = 0; i < sites.size(); ++i)
        nearest.consider({sites[i].position, i, sites[i].geometric_normal, 0}, position, normal);
    return nearest;
}

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }

/// Queries around the sites, at them, and one ulp beside them.
Vec3f random_query(const Sites& sites, Uniforms& random) {
    if (sites.empty() || random.below(4) == 0) return random.cube(-2, 2);
    Vec3f p = sites[random.below(static_cast<std::uint32_t>(sites.size()))].position;
    const std::uint32_t kind = random.below(4);
    if (kind == 1) p += 0.1f * random.cube(-1, 1);
    if (kind == 2) p[static_cast<int>(random.below(3))] = next_float_up(p[static_cast<int>(random.below(3))]);
    if (kind == 3)  // between two sites: ties on regular grids
        p = 0.5f * (p + sites[random.below(static_cast<std::uint32_t>(sites.size()))].position);
    return p;
}

void check_searches(const Sites& sites, int queries, const std::function<Vec3f(Uniforms&)>& normal) {
    const std::vector<KdNode> nodes = tree_of(sites);
    const std::unique_ptr<NanoflannIndex> index = sites.empty() ? nullptr : std::make_unique<NanoflannIndex>(sites);
    Uniforms random(41);
    for (int i = 0; i < queries; ++i) {
        const Vec3f position = random_query(sites, random);
        const Vec3f n = normal(random);
        const Nearest expected = search_sites(sites, position, n);
        Nearest found;
        search_kd_tree(view(nodes), position, n, found);
        REQUIRE(found.volume == expected.volume);
        REQUIRE(bits(found.distance2) == bits(expected.distance2));
        REQUIRE(find_volume(view(nodes), position, n) == expected.volume);
        REQUIRE(find_volume_by_all(view_of(nodes), position, n) == expected.volume);
        if (index != nullptr && n == Vec3f{0, 0, 1})
            REQUIRE(bits(index->nearest_distance2(position)) == bits(expected.distance2));
    }
}

Vec3f up(Uniforms&) { return {0, 0, 1}; }

/// Depth of the deepest node: how often a range can be halved.
int depth_of(std::size_t nodes) {
    int depth = 0;
    for (; nodes > 0; nodes /= 2) ++depth;
    return depth;
}

/// KdTreeView's promise: along a node's axis nothing before it is larger, nothing behind it smaller.
bool ordered(const std::vector<KdNode>& nodes, std::size_t low, std::size_t high) {
    if (low >= high) return true;
    const std::size_t middle = low + (high - low) / 2;
    const int axis = static_cast<int>(nodes[middle].axis);
    for (std::size_t i = low; i < high; ++i) {
        const float difference = nodes[i].position[axis] - nodes[middle].position[axis];
        if (i < middle ? difference > 0.0f : difference < 0.0f) return false;
    }
    return ordered(nodes, low, middle) && ordered(nodes, middle + 1, high);
}

}  // namespace

TEST_CASE("Few points or none are searched exactly") {
    for (int count = 0; count <= 4; ++count) {
        Uniforms random(static_cast<std::uint64_t>(count));
        check_searches(make_sites(count, [&](int) { return random.cube(-1, 1); }), 10000, up);
    }
    CHECK(find_volume(KdTreeView{}, {0, 0, 0}, {0, 0, 1}) == kNoVolume);
}

TEST_CASE("Random points are searched exactly") {
    Uniforms random(1);
    check_searches(make_sites(1000, [&](int) { return random.cube(-1, 1); }), 20000, up);
}

TEST_CASE("Duplicate and collinear and sorted points are searched exactly") {
    Uniforms random(2);
    const Vec3f places[] = {random.cube(-1, 1), random.cube(-1, 1)};
    check_searches(make_sites(1000, [&](int) { return places[0]; }), 2000, up);
    check_searches(make_sites(1000, [&](int) { return places[random.below(2)]; }), 2000, up);
    const Vec3f along = random.cube(-1, 1);
    check_searches(make_sites(500, [&](int i) { return static_cast<float>(i) * along; }), 5000, up);
    check_searches(make_sites(500, [&](int i) { return static_cast<float>(-i) * along; }), 5000, up);
    check_searches(make_sites(500, [&](int) { return random.between(-1, 1) * Vec3f{0, 1, 0}; }), 5000, up);
    check_searches(make_sites(500,
                              [&](int) {
                                  return Vec3f{random.between(-1, 1), 0.25f, random.between(-1, 1)};
                              }),
                   5000, up);
    check_searches(make_sites(500, [&](int) { return Vec3f{1e6f} + 1e-3f * random.cube(-1, 1); }), 5000, up);
}

TEST_CASE("Grids full of ties give the lowest number") {
    const auto at = [](int i) {
        return Vec3f{static_cast<float>(i % 8), static_cast<float>(i / 8 % 8), static_cast<float>(i / 64)} * 0.25f;
    };
    check_searches(make_sites(512, at), 20000, up);
    // The same with numbers in another order.
    check_searches(make_sites(512, [&](int i) { return at(i * 37 % 512); }), 20000, up);
}

TEST_CASE("The order of equal points in the tree does not matter") {
    Uniforms random(3);
    const Sites sites = make_sites(300, [&](int) { return 0.5f * glm::floor(random.cube(-2, 3)); });
    std::vector<KdNode> nodes = tree_of(sites);
    for (int i = 0; i < 5000; ++i) {
        const Vec3f query = 0.25f * glm::floor(random.cube(-4, 5));
        REQUIRE(find_volume(view(nodes), query, {0, 0, 1}) == search_sites(sites, query, {0, 0, 1}).volume);
    }
}

TEST_CASE("Normals filter the search") {
    Uniforms random(4);
    Sites sites = make_sites(1000, [&](int) { return random.cube(-1, 1); });
    for (SurfacePoint& s : sites) s.geometric_normal = random.direction();
    check_searches(sites, 20000, [](Uniforms& r) { return r.direction(); });
    // One that agrees, far away behind a thousand that do not; and none that does.
    for (SurfacePoint& s : sites) s.geometric_normal = {0, 1, 0};
    sites.push_back(site({9, 9, 9}));
    const std::vector<KdNode> nodes = tree_of(sites);
    CHECK(find_volume(view(nodes), {0, 0, 0}, {0, 0, 1}) == 1000);
    CHECK(find_volume(view(nodes), {0, 0, 0}, {0, 0, -1}) == kNoVolume);
    // The limit is exclusive: 0.8 does not agree, the next float does.
    CHECK_FALSE(normals_agree({0, 0, 1}, {0.6f, 0.0f, kMinNormalCosine}));
    CHECK(normals_agree({0, 0, 1}, {0.6f, 0.0f, next_float_up(kMinNormalCosine)}));
}

TEST_CASE("Queries on and beside every splitting plane are exact") {
    for (int tree = 0; tree < 50; ++tree) {
        Uniforms random(static_cast<std::uint64_t>(100 + tree));
        const Sites sites = make_sites(60, [&](int) { return random.cube(-1, 1); });
        const std::vector<KdNode> nodes = tree_of(sites);
        for (const KdNode& node : nodes)
            for (int side = -1; side <= 1; ++side) {
                Vec3f query = random.cube(-1, 1);
                float& x = query[static_cast<int>(node.axis)];
                x = node.position[static_cast<int>(node.axis)];
                x = side < 0 ? next_float_down(x) : (side > 0 ? next_float_up(x) : x);
                REQUIRE(find_volume(view(nodes), query, {0, 0, 1}) == search_sites(sites, query, {0, 0, 1}).volume);
            }
    }
}

TEST_CASE("Points and queries that are not finite find nothing") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Sites sites = make_sites(10, [](int i) { return Vec3f{static_cast<float>(i)}; });
    sites[3].position.y = nan;
    sites[7].position.x = kInfinity;
    const std::vector<KdNode> nodes = tree_of(sites);
    CHECK(nodes.size() == 8);
    CHECK(find_volume(view(nodes), Vec3f{3.1f}, {0, 0, 1}) != 3);
    for (const float bad : {nan, kInfinity, -kInfinity})
        for (int axis = 0; axis < 3; ++axis) {
            Vec3f query{1.0f};
            query[axis] = bad;
            CHECK(find_volume(view(nodes), query, {0, 0, 1}) == kNoVolume);
            CHECK(find_volume_by_all(view_of(nodes), query, {0, 0, 1}) == kNoVolume);
        }
    CHECK(find_volume(view(nodes), {1, 1, 1}, Vec3f{nan}) == kNoVolume);
}

TEST_CASE("The several nearest are those of a sorted list") {
    Uniforms random(5);
    const Sites sites = make_sites(400, [&](int) { return 0.25f * glm::floor(random.cube(-4, 5)); });
    const std::vector<KdNode> nodes = tree_of(sites);
    for (int i = 0; i < 2000; ++i) {
        const Vec3f query = 0.125f * glm::floor(random.cube(-8, 9));
        std::vector<std::pair<float, std::int32_t>> all;
        for (std::size_t s = 0; s < sites.size(); ++s)
            all.emplace_back(squared_distance(query, sites[s].position), static_cast<std::int32_t>(s));
        std::sort(all.begin(), all.end());
        NearestSeveral<8> nearest;
        search_kd_tree(view(nodes), query, {0, 0, 1}, nearest);
        REQUIRE(nearest.found == 8);
        for (int k = 0; k < 8; ++k) {
            REQUIRE(nearest.volume[k] == all[static_cast<std::size_t>(k)].second);
            REQUIRE(nearest.distance2[k] == all[static_cast<std::size_t>(k)].first);
        }
    }
    NearestSeveral<8> few;
    search_kd_tree(view(tree_of(Sites{site({0, 0, 0}), site({1, 0, 0})})), {2, 0, 0}, {0, 0, 1}, few);
    CHECK(few.found == 2);
    CHECK(few.volume[0] == 1);
}

namespace {

void check_tree(const Sites& sites) {
    const std::vector<KdNode> nodes = tree_of(sites);
    CHECK(nodes.size() == sites.size());
    CHECK(ordered(nodes, 0, nodes.size()));
}

/// A builder that is quadratic for equal points, or recurses once per point, does not come back from this.
void check_large_trees(int count) {
    Uniforms random(6);
    CHECK(depth_of(static_cast<std::size_t>(count)) <= kMaxKdDepth);
    check_tree(make_sites(count, [&](int) { return random.cube(-1, 1); }));
    check_tree(make_sites(count, [](int) { return Vec3f{0.5f}; }));
    check_tree(make_sites(count, [](int i) { return Vec3f{static_cast<float>(i % 2)}; }));
    check_tree(make_sites(count, [](int i) { return Vec3f{static_cast<float>(i), 0, 0}; }));
    check_tree(make_sites(count, [&](int) { return glm::floor(random.cube(0, 10)); }));
}

}  // namespace

TEST_CASE("Trees of 1e5 equal or sorted or tied points are built and ordered") { check_large_trees(100000); }

TEST_CASE("Trees of 1e6 equal or sorted or tied points are built and ordered", "[nightly]") {
    check_large_trees(1000000);
}
