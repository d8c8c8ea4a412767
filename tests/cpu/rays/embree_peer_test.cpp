// Embree as an independent peer: rays in general position hit the same triangles, at the same places.
#if PL_EMBREE_MAJOR > 0

#include "cpu/rays/batch_tracer.h"
#include "tests/cpu/rays/random_rays.h"
#include "tests/support/catch.hpp"
#include "tests/support/peers/embree_scene.h"

using namespace pl;
using namespace pl::test;

namespace {

HostScene soup() {
    SceneDescription description;
    description.materials.push_back(gray());
    Uniforms random(31);
    for (int i = 0; i < 300; ++i) {
        const Vec3f a = random.cube(-1.0f, 1.0f);
        add_triangle(description, a, a + 0.5f * random.cube(-1.0f, 1.0f), a + 0.5f * random.cube(-1.0f, 1.0f));
    }
    return pack_scene(description);
}

/// Seen from inside.
HostScene closed_mesh() {
    SceneDescription description;
    description.materials.push_back(gray());
    add_spiky_sphere(description, 16, 16, 1.0f, 3.0f, 32);
    return pack_scene(description);
}

}  // namespace

// Embree's own test rounds otherwise: near an edge, or between surfaces close together, the triangle may be another one. 3 of 1e5 bound
// the share of such rays by 1.3e-4 (confidence 99.9 %).
TEST_CASE("Rays in general position hit the triangles that Embree finds") {
    constexpr std::uint32_t kRays = 100000;
    for (const HostScene& scene : {soup(), closed_mesh()}) {
        const EmbreeScene embree(scene);
        Uniforms random(41);
        std::vector<Ray> rays(kRays);
        for (Ray& ray : rays) ray = {.origin = random.cube(-0.5f, 0.5f), .direction = random.direction()};
        const RayBatch batch = find_all(WideIntersector(scene.view()), rays);
        int hits = 0;
        int different = 0;
        int displaced = 0;
        for (std::uint32_t i = 0; i < kRays; ++i) {
            const Hit ours = batch.hit(i);
            const Hit theirs = embree.closest_hit(rays[i]);
            hits += theirs.found() ? 1 : 0;
            const bool is_same = ours.primitive == theirs.primitive && batch.occluded(i) == embree.occluded(rays[i]);
            different += is_same ? 0 : 1;
            if (is_same && ours.found()) displaced += std::fabs(ours.t - theirs.t) > 1e-4f ? 1 : 0;
        }
        CHECK(hits > 80000);
        CHECK(different <= 3);
        CHECK(displaced <= 3);
    }
}

#endif
