// No ray from inside a closed mesh gets out, for rays aimed inside facets, at vertices, at edges and far from the
// origin.
#include "core/kernel/geometry/intersector.h"

#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using test::Uniforms;

namespace {

enum class Aim { Anywhere, Vertices, Edges };

struct Misses {
    std::uint64_t rays = 0;
    std::uint64_t closest = 0;
    std::uint64_t occluded = 0;
    std::uint64_t moeller_trumbore = 0;
};

/// The usual test, which is not watertight: shows that the inputs find leaks. [Moeller and Trumbore 1997]
bool usual_test_hits(const Ray& ray, Vec3f a, Vec3f b, Vec3f c) {
    const Vec3f e1 = b - a;
    const Vec3f e2 = c - a;
    const Vec3f p = glm::cross(ray.direction, e2);
    const float inverse = 1.0f / glm::dot(e1, p);
    const Vec3f s = ray.origin - a;
    const float u = glm::dot(s, p) * inverse;
    const Vec3f q = glm::cross(s, e1);
    const float v = glm::dot(ray.direction, q) * inverse;
    return u >= 0.0f && v >= 0.0f && u + v <= 1.0f && glm::dot(e2, q) * inverse > 0.0f;
}

bool usual_test_misses_all(const SceneView& scene, const Ray& ray) {
    for (const Triangle& t : scene.triangles)
        if (usual_test_hits(ray, scene.positions[t.v0], scene.positions[t.v1], scene.positions[t.v2])) return false;
    return true;
}

Vec3f target_of(const SceneView& scene, Aim aim, Uniforms& random) {
    const Triangle& t = scene.triangles[random.below(scene.triangles.count)];
    const Vec3f a = scene.positions[t.v0];
    return aim == Aim::Vertices ? a : 0.5f * (a + scene.positions[t.v1]);
}

Misses shoot_from_center(const HostScene& packed, Vec3f center, Aim aim, std::uint64_t rays, bool compare) {
    const SceneView scene = packed.view();
    const BvhIntersector intersector{scene};
    Uniforms random(static_cast<std::uint64_t>(aim) + 17);
    Misses misses;
    for (; misses.rays < rays; ++misses.rays) {
        const Ray ray{.origin = center,
                      .direction =
                          aim == Aim::Anywhere ? random.direction() : target_of(scene, aim, random) - center};
        misses.closest += intersector.closest_hit(ray).found() ? 0u : 1u;
        misses.occluded += intersector.occluded(ray) ? 0u : 1u;
        misses.moeller_trumbore += compare && usual_test_misses_all(scene, ray) ? 1u : 0u;
    }
    return misses;
}

/// 16 x 16 facets with radii from 1 to 6, moved away from the origin.
HostScene spiky_sphere(float move, Vec3f& center) {
    SceneDescription scene;
    scene.materials.push_back(test::gray());
    test::add_spiky_sphere(scene, 16, 16, 1.0f, 6.0f, 5);
    center = Vec3f{move, 0.25f * move, -0.5f * move};
    test::transform(scene, true, 1.0f, center);
    return pack_scene(scene);
}

void check_watertight(std::uint64_t rays) {
    for (const float move : {0.0f, 10.0f, 1e3f, 148376.0f})
        for (const Aim aim : {Aim::Anywhere, Aim::Vertices, Aim::Edges}) {
            Vec3f center;
            const HostScene scene = spiky_sphere(move, center);
            const Misses misses = shoot_from_center(scene, center, aim, rays, false);
            INFO("moved by " << move << ", aim " << static_cast<int>(aim));
            CHECK(misses.rays == rays);
            CHECK(misses.closest == 0);
            CHECK(misses.occluded == 0);
        }
}

/// A fan of triangles a million times longer than wide, closed by a lid: all meet in one point.
HostScene sliver_cone() {
    SceneDescription scene;
    scene.materials.push_back(test::gray());
    constexpr int kSlivers = 400;
    const std::uint32_t tip = test::add_vertex(scene, {0, 0, 1e4f});
    const std::uint32_t base = test::add_vertex(scene, {0, 0, -1});
    for (int i = 0; i < kSlivers; ++i) {
        const double angle = 6.283185307179586 * i / kSlivers;
        test::add_vertex(scene, Vec3f{Vec3d{std::cos(angle), std::sin(angle), -1.0}});
    }
    for (std::uint32_t i = 0; i < kSlivers; ++i) {
        const std::uint32_t a = base + 1 + i;
        const std::uint32_t b = base + 1 + (i + 1) % kSlivers;
        test::add_triangle(scene, tip, a, b);
        test::add_triangle(scene, base, b, a);
    }
    return pack_scene(scene);
}

}  // namespace

TEST_CASE("A closed mesh is watertight to 2e4 rays each") { check_watertight(20000); }

TEST_CASE("A closed mesh is watertight to 1e6 rays each", "[nightly]") { check_watertight(1000000); }

TEST_CASE("A fan of slivers is watertight") {
    const HostScene scene = sliver_cone();
    for (const Aim aim : {Aim::Anywhere, Aim::Vertices, Aim::Edges}) {
        const Misses misses = shoot_from_center(scene, Vec3f{0.1f, 0.05f, 0.0f}, aim, 20000, false);
        CHECK(misses.closest == 0);
        CHECK(misses.occluded == 0);
    }
}

TEST_CASE("The same rays find the gaps of a test that is not watertight") {
    Vec3f center;
    const HostScene scene = spiky_sphere(0.0f, center);
    CHECK(shoot_from_center(scene, center, Aim::Vertices, 5000, true).moeller_trumbore > 0);
    CHECK(shoot_from_center(scene, center, Aim::Edges, 5000, true).moeller_trumbore > 0);
}
