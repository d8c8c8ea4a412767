// Rays meet instances where they meet copies of their meshes, bit by bit.
#include "core/kernel/geometry/instance_traversal.h"

#include "core/kernel/geometry/intersector.h"
#include "tests/support/catch.hpp"
#include "tests/support/rays/brute_force.h"
#include "tests/support/rays/hard_rays.h"
#include "tests/support/scenes/instanced_shapes.h"

using namespace pl;
using test::Uniforms;

namespace {

/// Rays towards hard points of the copies.
void check_against_copies(int rays) {
    for (const test::NamedShape& shape : test::hard_shapes())
        for (const test::Placing& placing : test::kPlacings) {
            Uniforms random(23);
            const SceneDescription description = test::instanced_shape(shape, placing, random);
            const HostScene instanced = pack_scene(description);
            const HostScene copied = pack_scene(test::with_copies(description));
            const BvhIntersector by_instances{instanced.view()};
            const BvhIntersector by_copies{copied.view()};
            REQUIRE(instanced.instances.size() == 12);
            REQUIRE(copied.instances.empty());
            int hits_of_instances = 0;
            int differences = 0;
            for (int i = 0; i < rays; ++i) {
                const Ray ray = test::hard_ray(copied.view(), random);
                const Hit expected = by_copies.closest_hit(ray);
                const Hit hit = by_instances.closest_hit(ray);
                const bool is_same = test::same_bits(expected, hit) && by_instances.occluded(ray) == expected.found();
                differences += is_same ? 0 : 1;
                hits_of_instances += hit.found() && hit.primitive >= instanced.planes.size() ? 1 : 0;
            }
            INFO(shape.name << ", " << placing.name);
            CHECK(differences == 0);
            CHECK(hits_of_instances > rays / 40);
        }
}

}  // namespace

TEST_CASE("Instances are hit as copies of their meshes are, to the bit, by 4e3 rays a scene") {
    check_against_copies(4000);
}

TEST_CASE("Instances are hit as copies of their meshes are, to the bit, by 2e5 rays a scene", "[nightly]") {
    check_against_copies(200000);
}

TEST_CASE("The bounds of an instance hold the corners of its triangles in both spaces") {
    Uniforms random(7);
    const SceneDescription description =
        test::instanced_shape(test::hard_shapes().front(), test::kPlacings[1], random);
    const HostScene packed = pack_scene(description);
    for (std::size_t i = 0; i < packed.instances.size(); ++i) {
        const Instance& instance = packed.instances[i];
        const MeshDescription& mesh = description.meshes[description.instances[i].mesh];
        for (std::uint32_t t = 0; t < mesh.triangle_count; ++t)
            for (int k = 0; k < 3; ++k) {
                const Vec3f corner = description.positions[description.triangles[mesh.first_triangle + t].vertex[k]];
                const Vec3f placed = instance.to_world.point(corner);
                const Vec3f back = instance.to_mesh.point(placed);
                CHECK(max_component(absolute(back - corner)) <=
                      instance.error + instance.error_per_distance * max_component(absolute(placed)));
                CHECK(glm::all(glm::greaterThanEqual(placed, packed.instance_nodes[0].low)));
                CHECK(glm::all(glm::lessThanEqual(placed, packed.instance_nodes[0].high)));
            }
    }
}

TEST_CASE("A ray of no direction or with a NaN meets no instance") {
    Uniforms random(3);
    const HostScene packed =
        pack_scene(test::instanced_shape(test::hard_shapes().front(), test::kPlacings[0], random));
    const BvhIntersector intersector{packed.view()};
    CHECK_FALSE(intersector.closest_hit({.origin = Vec3f{0.0f}, .direction = Vec3f{0.0f}}).found());
    CHECK_FALSE(intersector.closest_hit({.origin = Vec3f{kNan}, .direction = Vec3f{0.0f, 0.0f, 1.0f}}).found());
}
