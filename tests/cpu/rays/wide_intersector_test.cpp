// The wide hierarchy finds the hits of a test of all triangles, bit for bit, by every instruction set, whether rays are
// traced one by one or in turn.
#include "cpu/rays/batch_tracer.h"

#include <algorithm>
#include <limits>

#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/rays/brute_force.h"
#include "tests/support/rays/hard_rays.h"

using namespace pl;
using namespace pl::test;

namespace {

std::vector<NamedScene> hard_scenes() {
    std::vector<NamedScene> scenes;
    const auto add = [&](const std::string& name, const std::function<void(SceneDescription&)>& build) {
        scenes.push_back({name, gray_scene(build)});
    };
    for (const NamedShape& shape : hard_shapes())
        add(shape.name, [&](SceneDescription& s) {
            Uniforms random(11);
            shape.build(s, random);
        });
    add("one triangle", [](auto& s) { add_triangle(s, {-1, -1, 0}, {1, -1, 0.5f}, {0, 1, 0}); });
    add("a hundred times the same", [](auto& s) {
        for (int i = 0; i < 100; ++i) add_triangle(s, {-1, -1, 0}, {1, -1, 0.5f}, {0, 1, 0});
    });
    for (const float size : {1e-12f, 1e12f})
        add(size > 1.0f ? "huge" : "tiny", [size](auto& s) { add_spiky_sphere(s, 12, 12, size, 6.0f * size, 3); });
    return scenes;
}

std::vector<WideIntersector> all_ways(const SceneView& scene) {
    std::vector<WideIntersector> ways;
    for (const LaneKernels& kernels : usable_lane_kernels())
        for (const std::size_t cache_bytes : {std::size_t{0}, WideIntersector::kCacheBytes})
            ways.emplace_back(scene, kernels, cache_bytes);
    return ways;
}

/// Rays of a batch whose hits or occlusion are not the expected ones.
int differences(const WideIntersector& wide, RayBatch& batch, const std::vector<Hit>& expected) {
    const auto count = static_cast<std::uint32_t>(expected.size());
    wide.find_closest(batch, count);
    wide.find_occluded(batch, count);
    int different = 0;
    for (std::uint32_t i = 0; i < count; ++i)
        different += same_bits(batch.hit(i), expected[i]) && batch.occluded(i) == expected[i].found() ? 0 : 1;
    return different;
}

/// Batches of 1000 rays, so that the last group is never full. Rays that pass beside slivers may be lost, see box_slack().
void check_against_all(int batches) {
    constexpr std::uint32_t kRays = 1000;
    for (const NamedScene& named : hard_scenes()) {
        const SceneView scene = named.scene.view();
        const std::vector<WideIntersector> ways = all_ways(scene);
        Uniforms random(12);
        int hits = 0;
        int different = 0;
        for (int b = 0; b < batches; ++b) {
            RayBatch batch(kRays);
            std::vector<Hit> expected;
            for (std::uint32_t i = 0; i < kRays; ++i) {
                const Ray ray = hard_ray(scene, random);
                batch.set_ray(i, ray);
                expected.push_back(closest_hit_by_all(scene, ray));
                hits += expected.back().found() ? 1 : 0;
            }
            for (const WideIntersector& wide : ways) different += differences(wide, batch, expected);
        }
        INFO(named.name);
        const bool is_thin = named.name == "thin slivers";
        const int beside = is_thin ? static_cast<int>(ways.size()) * (batches * static_cast<int>(kRays) / 500000) : 0;
        CHECK(different <= beside);
        CHECK(hits > batches * static_cast<int>(kRays) / 50);
    }
}

/// Checks the boxes and triangles of a child; `seen` counts the triangles that it finds.
void check_child(const SceneView& scene, const std::vector<WideNode>& nodes, const WideNode& parent, std::uint32_t i,
                 std::vector<int>& seen) {
    const WideReference child = parent.children[i];
    for (int axis = 0; axis < 3; ++axis) {
        const float low = parent.planes[axis][0][i];
        const float high = parent.planes[axis][1][i];
        for (std::uint32_t t = child.first(); t < child.first() + child.count(); ++t) {
            const BvhTriangle& triangle = scene.bvh.triangles[t];
            for (const Vec3f& p : {triangle.p0, triangle.p1, triangle.p2})
                REQUIRE((low <= p[axis] && p[axis] <= high));
        }
        if (child.count() > 0) continue;
        const WideNode& node = nodes[child.first()];
        for (std::uint32_t k = 0; k < kWideChildren; ++k)
            if (((node.child_bits >> k) & 1u) != 0)
                REQUIRE((low <= node.planes[axis][0][k] && node.planes[axis][1][k] <= high));
    }
    REQUIRE(child.count() <= kWideChildren);
    for (std::uint32_t t = child.first(); t < child.first() + child.count(); ++t)
        ++seen[scene.bvh.triangles[t].primitive];
}

}  // namespace

TEST_CASE("The wide hierarchy agrees with all triangles for 1e6 rays") { check_against_all(67); }

TEST_CASE("The wide hierarchy agrees with all triangles for 1e8 rays", "[nightly]") { check_against_all(6700); }

TEST_CASE("Every triangle hangs once in the wide hierarchy, inside the boxes above it") {
    for (const NamedScene& named : hard_scenes()) {
        INFO(named.name);
        const SceneView scene = named.scene.view();
        const std::vector<WideNode> nodes = make_wide_nodes(scene.bvh);
        std::vector<int> seen(scene.triangles.count, 0);
        std::size_t inner = 0;
        for (const WideNode& node : nodes)
            for (std::uint32_t i = 0; i < kWideChildren; ++i) {
                if (((node.child_bits >> i) & 1u) == 0) continue;
                check_child(scene, nodes, node, i, seen);
                inner += node.children[i].count() == 0 ? 1 : 0;
            }
        CHECK(inner + 1 == nodes.size());
        CHECK(std::ranges::all_of(seen, [](int times) { return times == 1; }));
    }
}

TEST_CASE("Blocks of leaves hold their triangles in order, the last one repeated") {
    for (const NamedScene& named : hard_scenes()) {
        INFO(named.name);
        const SceneView scene = named.scene.view();
        const std::vector<WideNode> before = make_wide_nodes(scene.bvh);
        std::vector<WideNode> nodes = before;
        const std::vector<LeafBlock> blocks = make_leaf_blocks(nodes, scene.bvh.triangles);
        std::size_t leaves = 0;
        for (std::size_t n = 0; n < nodes.size(); ++n)
            for (std::uint32_t i = 0; i < kWideChildren; ++i) {
                const WideReference leaf = before[n].children[i];
                if (((before[n].child_bits >> i) & 1u) == 0 || leaf.count() == 0) continue;
                REQUIRE(nodes[n].children[i].first() == leaves);
                REQUIRE(nodes[n].children[i].count() == leaf.count());
                const LeafBlock& block = blocks[leaves++];
                for (std::uint32_t lane = 0; lane < kWideChildren; ++lane) {
                    const BvhTriangle& t = scene.bvh.triangles[leaf.first() + std::min(lane, leaf.count() - 1)];
                    REQUIRE(block.primitives[lane] == t.primitive);
                    for (int axis = 0; axis < 3; ++axis) {
                        REQUIRE(block.corners[0][axis][lane] == t.p0[axis]);
                        REQUIRE(block.corners[1][axis][lane] == t.p1[axis]);
                        REQUIRE(block.corners[2][axis][lane] == t.p2[axis]);
                    }
                }
            }
        CHECK(leaves == blocks.size());
    }
}

TEST_CASE("A wide node has more than five children in the mean") {
    const HostScene scene = gray_scene([](auto& s) { add_spiky_sphere(s, 64, 64, 1.0f, 1.5f, 3); });
    const std::vector<WideNode> nodes = make_wide_nodes(scene.view().bvh);
    double children = 0.0;
    for (const WideNode& node : nodes) children += std::popcount(node.child_bits);
    CHECK(children > 5.0 * static_cast<double>(nodes.size()));
}

TEST_CASE("Rays without a direction or with components that are no numbers hit nothing in the wide hierarchy") {
    const HostScene scene = gray_scene([](auto& s) { add_spiky_sphere(s, 12, 12, 1.0f, 2.0f, 3); });
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<Ray> rays{{.direction = Vec3f{0.0f}},
                                {.direction = {kNan, 1, 0}},
                                {.direction = {kInfinity, 1, 0}},
                                {.origin = {kNan, 0, 0}},
                                {.origin = {0, -kInfinity, 0}},
                                {.t_max = kNan},
                                {.t_max = -1.0f},
                                {.t_max = 0.0f},
                                {}};
    RayBatch batch(static_cast<std::uint32_t>(rays.size()));
    std::vector<Hit> expected;
    for (std::uint32_t i = 0; i < rays.size(); ++i) {
        batch.set_ray(i, rays[i]);
        expected.push_back(BvhIntersector{scene.view()}.closest_hit(rays[i]));
    }
    CHECK(expected.back().found());
    for (const WideIntersector& wide : all_ways(scene.view())) CHECK(differences(wide, batch, expected) == 0);
}

TEST_CASE("The wide hierarchy of an empty scene is missed") {
    const HostScene scene = pack_scene(SceneDescription{});
    RayBatch batch(3);
    for (const WideIntersector& wide : all_ways(scene.view()))
        CHECK(differences(wide, batch, {Hit{}, Hit{}, Hit{}}) == 0);
}

TEST_CASE("The wide hierarchy follows a scene whose arrays move") {
    const HostScene scene = gray_scene([](auto& s) { add_spiky_sphere(s, 12, 12, 1.0f, 2.0f, 3); });
    auto copy = std::make_unique<HostScene>(scene);
    WideIntersector wide(copy->view());
    wide.move_to(scene.view());
    copy.reset();
    RayBatch batch(1);
    CHECK(differences(wide, batch, {closest_hit_by_all(scene.view(), Ray{})}) == 0);
}
