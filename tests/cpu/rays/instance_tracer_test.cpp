// Rays meet instances where they meet copies of their meshes, bit by bit and by every instruction set.
#include "cpu/rays/batch_tracer.h"

#include "tests/support/catch.hpp"
#include "tests/support/rays/brute_force.h"
#include "tests/support/scenes/instanced_shapes.h"

using namespace pl;
using test::Uniforms;

namespace {

/// A scene's direct triangles and its instances, by one instruction set.
struct Tracers {
    WideIntersector direct;
    InstanceTracer instances;

    Tracers(const SceneView& scene, const LaneKernels& kernels)
        : direct(scene, kernels), instances(scene.instances, kernels) {}

    void find(RayBatch& batch, std::uint32_t count) const {
        direct.find_closest(batch, count);
        instances.find_closest(batch, count);
        direct.find_occluded(batch, count);
        instances.find_occluding(batch, count);
    }
};

/// Random rays towards hard points, and their hits by a test of all copies: hierarchies may lose rays that pass beside slivers, see
/// box_slack(). The last group is not full.
struct ExpectedHits {
    static constexpr std::uint32_t kRays = 1000;

    RayBatch batch{kRays};
    std::vector<Hit> hits;

    ExpectedHits(const SceneView& copies, Uniforms& random) {
        for (std::uint32_t i = 0; i < kRays; ++i) {
            const Ray ray = test::hard_ray(copies, random);
            batch.set_ray(i, ray);
            hits.push_back(test::closest_hit_by_all(copies, ray));
        }
    }
};

int differences(const Tracers& tracers, ExpectedHits& expected) {
    tracers.find(expected.batch, ExpectedHits::kRays);
    int different = 0;
    for (std::uint32_t i = 0; i < ExpectedHits::kRays; ++i) {
        const Hit& hit = expected.hits[i];
        const bool is_same = test::same_bits(expected.batch.hit(i), hit) && expected.batch.occluded(i) == hit.found();
        different += is_same ? 0 : 1;
    }
    return different;
}

void check_against_copies(int batches) {
    for (const test::NamedShape& shape : test::hard_shapes())
        for (const test::Placing& placing : test::kPlacings) {
            Uniforms random(29);
            const SceneDescription description = test::instanced_shape(shape, placing, random);
            const HostScene instanced = pack_scene(description);
            const HostScene copied = pack_scene(test::with_copies(description));
            std::vector<Tracers> ways;
            for (const LaneKernels& kernels : usable_lane_kernels()) ways.emplace_back(instanced.view(), kernels);
            int different = 0;
            int hits_of_instances = 0;
            for (int b = 0; b < batches; ++b) {
                ExpectedHits expected(copied.view(), random);
                for (const Hit& hit : expected.hits)
                    hits_of_instances += hit.found() && hit.primitive >= instanced.planes.size() ? 1 : 0;
                for (const Tracers& tracers : ways) different += differences(tracers, expected);
            }
            INFO(shape.name << ", " << placing.name);
            CHECK(different == 0);
            CHECK(hits_of_instances > batches * static_cast<int>(ExpectedHits::kRays) / 40);
        }
}

}  // namespace

TEST_CASE("Lanes meet instances where rays meet copies, to the bit, for 3e3 rays a scene") {
    check_against_copies(3);
}

TEST_CASE("Lanes meet instances where rays meet copies, to the bit, for 2e5 rays a scene", "[nightly]") {
    check_against_copies(200);
}

TEST_CASE("A hierarchy over instances has one to a leaf, and one hierarchy a mesh") {
    Uniforms random(31);
    const HostScene packed =
        pack_scene(test::instanced_shape(test::hard_shapes().front(), test::kPlacings[0], random));
    const InstancesView instances = packed.view().instances;
    constexpr std::uint32_t kRoot = 0;
    std::vector<int> seen(instances.list.count, 0);
    for (const WideNode& node : make_wide_nodes(instances.nodes, {&kRoot, 1}, 1))
        for (std::uint32_t i = 0; i < kWideChildren; ++i) {
            const WideReference child = node.children[i];
            if (((node.child_bits >> i) & 1u) == 0 || child.count() == 0) continue;
            REQUIRE(child.count() == 1);
            ++seen[instances.order[child.first()]];
        }
    CHECK(std::ranges::all_of(seen, [](int times) { return times == 1; }));
}

TEST_CASE("Wide hierarchies of several meshes have their roots first and share no node") {
    Uniforms random(37);
    const HostScene packed =
        pack_scene(test::instanced_shape(test::hard_shapes().front(), test::kPlacings[0], random));
    const InstancesView instances = packed.view().instances;
    std::vector<std::uint32_t> roots;
    for (const Instance& instance : instances.list)
        if (std::ranges::find(roots, instance.root) == roots.end()) roots.push_back(instance.root);
    REQUIRE(roots.size() == 2);
    const std::vector<WideNode> nodes = make_wide_nodes(instances.mesh_nodes, roots);
    std::vector<int> parents(nodes.size(), 0);
    std::vector<int> seen(instances.mesh_triangles.count, 0);
    for (const WideNode& node : nodes)
        for (std::uint32_t i = 0; i < kWideChildren; ++i) {
            const WideReference child = node.children[i];
            if (((node.child_bits >> i) & 1u) == 0) continue;
            if (child.count() == 0) ++parents[child.first()];
            for (std::uint32_t t = child.first(); t < child.first() + child.count(); ++t) ++seen[t];
        }
    CHECK(std::all_of(parents.begin(), parents.begin() + 2, [](int count) { return count == 0; }));
    CHECK(std::all_of(parents.begin() + 2, parents.end(), [](int count) { return count == 1; }));
    CHECK(std::ranges::all_of(seen, [](int times) { return times == 1; }));
}

TEST_CASE("A ray of no direction or with a NaN meets no instance in lanes") {
    Uniforms random(3);
    const HostScene packed =
        pack_scene(test::instanced_shape(test::hard_shapes().front(), test::kPlacings[0], random));
    RayBatch batch(2);
    batch.set_ray(0, {.origin = Vec3f{0.0f}, .direction = Vec3f{0.0f}});
    batch.set_ray(1, {.origin = Vec3f{kNan}, .direction = Vec3f{0.0f, 0.0f, 1.0f}});
    for (const LaneKernels& kernels : usable_lane_kernels()) {
        Tracers(packed.view(), kernels).find(batch, 2);
        for (const std::uint32_t i : {0u, 1u}) {
            CHECK_FALSE(batch.hit(i).found());
            CHECK_FALSE(batch.occluded(i));
        }
    }
}
