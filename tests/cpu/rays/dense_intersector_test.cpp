// Hits of the dense intersector, with every instruction set, and of the BVH have the bits of the scalar
// test on all triangles.
#include <algorithm>

#include "core/base/error.h"
#include "cpu/rays/batch_tracer.h"
#include "tests/cpu/rays/bvh_batch.h"
#include "tests/cpu/rays/random_rays.h"
#include "tests/support/catch.hpp"

using namespace pl;
using namespace pl::test;

namespace {

constexpr std::uint32_t kDenseRays = 4096;

void add_random_triangles(SceneDescription& scene, int count, std::uint64_t seed) {
    Uniforms random(seed);
    for (int i = 0; i < count; ++i) {
        const Vec3f a = random.cube(-1.0f, 1.0f);
        add_triangle(scene, a, a + random.cube(-1.0f, 1.0f), a + random.cube(-1.0f, 1.0f));
    }
}

/// Corners at multiples of 1/8: rays through edges, coplanar triangles and exactly zero edge functions are frequent.
void add_grid_triangles(SceneDescription& scene, int count, std::uint64_t seed) {
    Uniforms random(seed);
    const auto on_grid = [&] { return glm::round(random.cube(-4.0f, 4.0f)) / 4.0f; };
    for (int i = 0; i < count; ++i) {
        const Vec3f a = on_grid();
        const Vec3f b = on_grid();
        add_triangle(scene, a, b, on_grid());
    }
}

std::vector<NamedScene> small_scenes() {
    std::vector<NamedScene> scenes;
    const auto add = [&](const std::string& name, const std::function<void(SceneDescription&)>& build) {
        scenes.push_back({name, gray_scene(build)});
    };
    for (const int count : {1, 2, 7, 36, 64})
        add("random " + std::to_string(count), [&](auto& s) { add_random_triangles(s, count, 11); });
    add("grid", [](auto& s) { add_grid_triangles(s, 64, 12); });
    add("room with a block", [](auto& s) {
        add_box(s, Vec3f{-1.0f}, Vec3f{1.0f}, true);
        add_box(s, {-0.5f, -1.0f, -0.5f}, {0.5f, 0.0f, 0.5f}, false);
    });
    add("everything twice", [](auto& s) {
        add_random_triangles(s, 16, 13);
        const auto once = s.triangles;
        s.triangles.insert(s.triangles.end(), once.begin(), once.end());
    });
    add("degenerate", [](auto& s) {
        add_random_triangles(s, 8, 14);
        const Vec3f a{0.1f, 0.2f, 0.3f};
        const Vec3f b{-0.7f, 0.4f, 0.2f};
        add_triangle(s, a, a, b);
        add_triangle(s, a, b, b);
        add_triangle(s, a, a, a);
        add_triangle(s, a, 0.5f * (a + b), b);
    });
    add("empty", [](auto&) {});
    return scenes;
}

/// Counts of the special cases, so that a test cannot pass without covering them.
struct Seen {
    int hits = 0;
    int misses = 0;
    int occluded = 0;
};

template <BatchIntersector I>
Seen check_all_rays(const HostScene& scene, const I& intersector) {
    const std::vector<Ray> rays = random_rays(scene.view(), kDenseRays, 21);
    const RayBatch batch = find_all(intersector, rays);
    Seen seen;
    for (std::uint32_t i = 0; i < kDenseRays; ++i) {
        INFO("ray " << i);
        const Hit expected = closest_hit_by_all(scene.view(), rays[i]);
        REQUIRE(same_bits(batch.hit(i), expected));
        REQUIRE(batch.occluded(i) == expected.found());
        ++(expected.found() ? seen.hits : seen.misses);
        seen.occluded += batch.occluded(i) ? 1 : 0;
    }
    return seen;
}

}  // namespace

TEST_CASE("Every instruction set finds the hits of the scalar test, bit for bit") {
    for (const NamedScene& named : small_scenes())
        for (const LaneKernels& kernels : usable_lane_kernels()) {
            INFO(named.name << ", " << kernels.isa);
            const Seen seen = check_all_rays(named.scene, DenseIntersector(named.scene.view(), kernels));
            CHECK(seen.misses > 0);
            if (named.scene.triangles.size() >= 7) {
                CHECK(seen.hits > 100);
                CHECK(seen.occluded == seen.hits);
            }
        }
}

TEST_CASE("The hierarchy finds the same hits in a batch") {
    for (const NamedScene& named : small_scenes()) {
        INFO(named.name);
        check_all_rays(named.scene, BvhBatch(named.scene.view()));
    }
}

// Power of the test above: the rays must cover all special cases of the code.
TEST_CASE("Test rays run exactly through edges") {
    std::vector<NamedScene> scenes = small_scenes();
    const auto grid = std::find_if(scenes.begin(), scenes.end(), [](auto& s) { return s.name == "grid"; });
    int zeros = 0;
    for (const Ray& ray : random_rays(grid->scene.view(), kDenseRays, 21)) {
        const ScalarRaySpace space = make_ray_space(ray);
        for (const Triangle& t : grid->scene.triangles) {
            const auto in_ray_space = [&](std::uint32_t vertex) {
                const Vec3f p = grid->scene.positions[vertex];
                return to_ray_space(space, p.x, p.y, p.z);
            };
            const auto e = edge_functions(in_ray_space(t.v0), in_ray_space(t.v1), in_ray_space(t.v2));
            zeros += (e.u == 0.0f) + (e.v == 0.0f) + (e.w == 0.0f);
        }
    }
    CHECK(zeros > 1000);
}

TEST_CASE("Batches that do not fill a group are answered in full") {
    SceneDescription description;
    description.materials.push_back(gray());
    add_box(description, Vec3f{-1.0f}, Vec3f{1.0f}, true);
    const HostScene scene = pack_scene(description);
    const DenseIntersector dense(scene.view());
    Uniforms random(3);
    for (const std::uint32_t count : {1u, 15u, 16u, 17u, 31u}) {
        RayBatch batch(count);
        for (std::uint32_t i = 0; i < count; ++i)
            batch.set_ray(i, {.origin = random.cube(-0.9f, 0.9f), .direction = random.direction()});
        dense.find_closest(batch, count);
        dense.find_occluded(batch, count);
        for (std::uint32_t i = 0; i < count; ++i) {
            CHECK(same_bits(batch.hit(i), closest_hit_by_all(scene.view(), batch.ray(i))));
            CHECK(batch.occluded(i));
        }
    }
}

TEST_CASE("The dense intersector refuses scenes that are too large for it") {
    SceneDescription description;
    description.materials.push_back(gray());
    add_random_triangles(description, 65, 1);
    CHECK_THROWS_AS(DenseIntersector(pack_scene(description).view()), Error);
}

TEST_CASE("The tracer takes the dense intersector up to 64 triangles, then the wide hierarchy") {
    SceneDescription description;
    description.materials.push_back(gray());
    add_random_triangles(description, 64, 1);
    const HostScene small = pack_scene(description);
    CHECK_THAT(BatchTracer(small.view()).name(), contains("dense"));
    add_random_triangles(description, 1, 2);
    const HostScene large = pack_scene(description);
    CHECK_THAT(BatchTracer(large.view()).name(), contains("wide"));
}
