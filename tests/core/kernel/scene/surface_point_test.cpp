// Rays spawned at a surface: they do not hit it again, offsets stay small, and shadow segments end at their light.
#include "tests/support/catch.hpp"
#include "tests/support/rays/walk.h"

using namespace pl;
using namespace pl::test;

namespace {

/// A quad of two triangles of about `size`, a sixth of that high if it is to be narrow, at `place`.
HostScene make_quad(Uniforms& random, float size, Vec3f place, bool narrow) {
    const Frame frame = make_frame(random.direction());
    const Vec3f right = size * frame.x;
    const Vec3f up = (narrow ? size / 6.0f : size) * frame.y;
    SceneDescription scene;
    scene.materials.push_back(gray());
    const Vec3f corner = place + size * random.cube(-1, 1);
    for (const Vec3f p : {corner, corner + right, corner + right + up, corner + up}) add_vertex(scene, p);
    add_quad(scene, 0, 1, 2, 3);
    return pack_scene(scene);
}

Hit random_hit(Uniforms& random) {
    const Vec2f b = square_to_triangle(random.square());
    return {.t = 1.0f, .primitive = random.below(2), .b1 = b.x, .b2 = b.y};
}

struct SelfHits {
    std::uint64_t rays = 0;
    std::uint64_t hits = 0;
    double largest_step = 0.0;  ///< in 32 ulp(max |p|) + 32 u extent
};

SelfHits leave_quads(float size, Vec3f place, bool narrow, std::uint64_t quads) {
    Uniforms random(21);
    SelfHits result;
    for (std::uint64_t i = 0; i < quads; ++i) {
        const HostScene packed = make_quad(random, size, place, narrow);
        const SceneView scene = packed.view();
        for (int k = 0; k < 100; ++k, ++result.rays) {
            const Vec3f wo = random.direction();
            const SurfacePoint point = make_surface_point<FeatureSet{}>(scene, random_hit(random), wo);
            const Vec3f direction = lambert_sample(point, random.square());
            if (glm::dot(direction, point.geometric_normal) <= 0.0f) continue;
            const Ray ray = spawn_ray(point, direction);
            result.hits += BvhIntersector{scene}.closest_hit(ray).found() ? 1u : 0u;
            const Vec3f a = absolute(point.position);
            const double allowed = 64.0 * 0x1p-24 * static_cast<double>(max_component(a)) +
                                   32.0 * 0x1p-24 * 1.5 * static_cast<double>(size);
            const double step = glm::length(Vec3d{ray.origin} - Vec3d{point.position});
            result.largest_step = max_of(result.largest_step, step / allowed);
        }
    }
    return result;
}

void check_self_hits(std::uint64_t quads) {
    for (const float size : {1e-6f, 1e-3f, 1.0f, 1e3f, 1e6f})
        for (const float place : {0.0f, 1.0f, 1e3f, 1e6f})
            for (const bool narrow : {false, true}) {
                if (place > 1e4f * size) continue;  // floats cannot distinguish the corners
                const SelfHits result = leave_quads(size, place * Vec3f{0.7f, -0.5f, 0.4f}, narrow, quads);
                INFO("size " << size << " at " << place << (narrow ? ", narrow" : ""));
                CHECK(result.hits == 0);
                CHECK(result.largest_step <= 1.0);
            }
}

}  // namespace

TEST_CASE("Rays do not meet the quad that they leave in 1e4 rays a cell") { check_self_hits(100); }

TEST_CASE("Rays do not meet the quad that they leave in 2e6 rays a cell", "[nightly]") { check_self_hits(20000); }

TEST_CASE("Hits are kept off the edges and in their triangle") {
    Uniforms random(22);
    for (int i = 0; i < 100000; ++i) {
        Hit hit = random_hit(random);
        if (i % 2 == 0) move_to_edge(hit, random);
        const float margin = 0.0625f * random.next();
        const Vec3f b = inner_barycentrics(hit, margin);
        REQUIRE(std::fabs(b.x + b.y + b.z - 1.0f) <= 4.0f * kRoundoff);
        // Two weights of a sixteenth at most are added before all are divided by the sum.
        REQUIRE(min_of(b.x, min_of(b.y, b.z)) >= margin * (1.0f - 2.0f * margin - 4.0f * kRoundoff));
    }
}

TEST_CASE("Smooth normals are those of the hit and not of the moved point") {
    SceneDescription description;
    description.materials.push_back(gray());
    add_triangle(description, Vec3f{0, 0, 0}, Vec3f{1, 0, 0}, Vec3f{0, 1, 0});
    description.normals = {Vec3f{0, 0, 1}, glm::normalize(Vec3f{1, 0, 1}), glm::normalize(Vec3f{0, 1, 1})};
    description.triangles[0].normal = {0, 1, 2};
    const HostScene scene = pack_scene(description);
    constexpr FeatureSet kSmooth = FeatureSet{}.with(Feature::SmoothNormals);
    const Hit corner{.t = 1.0f, .primitive = 0, .b1 = 1.0f, .b2 = 0.0f};
    const SurfacePoint point = make_surface_point<kSmooth>(scene.view(), corner, {0, 0, 1});
    CHECK(glm::length(point.shading_normal - glm::normalize(Vec3f{1, 0, 1})) < 1e-6f);
    CHECK(point.geometric_normal == Vec3f{0, 0, 1});
    CHECK(make_surface_point<FeatureSet{}>(scene.view(), corner, {0, 0, 1}).shading_normal == Vec3f{0, 0, 1});
    // From behind, both normals turn around.
    const SurfacePoint behind = make_surface_point<kSmooth>(scene.view(), corner, {0, 0, -1});
    CHECK_FALSE(behind.front);
    CHECK(behind.geometric_normal == Vec3f{0, 0, -1});
    CHECK(glm::dot(behind.shading_normal, behind.geometric_normal) > 0.0f);
}

// An isolated pair of triangles, and a third between them.
TEST_CASE("Shadow segments are free of their ends and blocked in between") {
    Uniforms random(23);
    for (int i = 0; i < 20000; ++i) {
        const float length = std::pow(10.0f, random.between(-4, 4));
        const Vec3f place = random.cube(-1, 1) * length;
        const float blocker = random.below(3) == 0 ? 0.5f : (random.below(2) == 0 ? 0.001f : 0.999f);
        SceneDescription description;
        description.materials.push_back(gray());
        for (const float z : {0.0f, 1.0f, blocker}) {
            const float half = 0.5f + 10.0f * (z == blocker ? 1.0f : 0.0f);
            add_triangle(description, place + length * Vec3f{-half, -half, z}, place + length * Vec3f{half, -half, z},
                         place + length * Vec3f{0, half, z});
        }
        const HostScene all = pack_scene(description);
        description.triangles.pop_back();
        const HostScene pair = pack_scene(description);
        const Hit from{.t = 1.0f, .primitive = 0, .b1 = 0.3f * random.next(), .b2 = 0.3f * random.next()};
        const Hit to{.t = 1.0f, .primitive = 1, .b1 = 0.3f * random.next(), .b2 = 0.3f * random.next()};
        const Ray ray = spawn_shadow_ray(make_surface_point<FeatureSet{}>(all.view(), from, {0, 0, 1}),
                                         make_surface_point<FeatureSet{}>(all.view(), to, {0, 0, -1}));
        REQUIRE_FALSE(BvhIntersector{pair.view()}.occluded(ray));
        REQUIRE(BvhIntersector{all.view()}.occluded(ray));
    }
}
