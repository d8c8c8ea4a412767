// The ray-triangle test alone: signs, sides, ties, planes and bad numbers.
#include "core/kernel/geometry/triangle.h"

#include "core/kernel/base/warp.h"

#include "tests/support/catch.hpp"
#include "tests/support/rays/brute_force.h"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using test::Uniforms;

namespace {

using Corner = RayVector<float>;

Hit hit_of(const Ray& ray, Vec3f a, Vec3f b, Vec3f c, std::uint32_t primitive = 0, Hit best = {}) {
    intersect_triangle(make_ray_space(ray), a, b, c, primitive, best);
    return best;
}

/// Bitwise, but for the sign of zero, which decides nothing.
bool antisymmetric(const Corner& p, const Corner& q) {
    return edge_function(p, q) == -edge_function(q, p) && exact_edge_function(p, q) == -exact_edge_function(q, p);
}

struct RandomTriangle {
    Vec3f a, b, c;

    explicit RandomTriangle(Uniforms& random) : a(random.cube(-1, 1)), b(random.cube(-1, 1)), c(random.cube(-1, 1)) {}
    Vec3f point(Uniforms& random) const {
        const Vec2f b12 = square_to_triangle(random.square());
        return (1.0f - b12.x - b12.y) * a + b12.x * b + b12.y * c;
    }
};

}  // namespace

// The heart of watertightness: two triangles see their common edge from opposite ends. A contracted multiply-add
// breaks this for nearly every pair.
TEST_CASE("Edge functions are antisymmetric bit by bit") {
    Uniforms random(1);
    bool all = true;
    for (int i = 0; i < 2000000; ++i) {
        const Corner p{random.between(-1, 1), random.between(-1, 1), 0.0f};
        const float t = random.between(-2, 2);  // almost on a line through the origin
        const Corner q{p.x * t, p.y * t + random.between(-1, 1) * 1e-7f, 0.0f};
        all = all && antisymmetric(p, q);
    }
    CHECK(all);
}

// Kettner's construction: a grid of neighboring floats around a degenerate configuration.
TEST_CASE("Edge functions are antisymmetric on a grid around a degenerate point") {
    const Corner q{12.0f, 12.0f, 0.0f};
    bool all = true;
    int negative = 0;
    int positive = 0;
    float x = 0.5f;
    for (int i = 0; i < 256; ++i, x = next_float_up(x)) {
        float y = 0.5f;
        for (int j = 0; j < 256; ++j, y = next_float_up(y)) {
            all = all && antisymmetric({x, y, 0.0f}, q);
            const float e = exact_edge_function({x, y, 0.0f}, q);
            negative += e < 0.0f ? 1 : 0;
            positive += e > 0.0f ? 1 : 0;
            // In double the two products are exact, so e has the sign of i - j.
            all = all && ((e > 0.0f) == (i > j)) && ((e < 0.0f) == (i < j));
        }
    }
    CHECK(all);
    CHECK(negative == positive);
}

// A ray along z from the origin sees corners as they are. Where the float products of an edge cancel to 0 although the
// origin lies outside by less than rounding, the exact products must refuse the hit, and the neighbor must take it.
TEST_CASE("Edges that rounding cannot decide are decided exactly") {
    Uniforms random(7);
    int undecided = 0;
    for (int i = 0; i < 4000000 && undecided < 200; ++i) {
        const Vec3f a{random.between(0.5f, 1), random.between(0.5f, 1), 1};
        const float back = -random.between(0.5f, 1);
        const Vec3f b{a.x * back, a.y * back, 1};
        const Corner p{a.x, a.y, 1}, q{b.x, b.y, 1};
        const float exact = exact_edge_function(p, q);
        if (edge_function(p, q) != 0.0f || exact == 0.0f) continue;
        ++undecided;
        const bool left = hit_of({}, a, b, {-3, 3, 1}).found();
        const bool right = hit_of({}, a, b, {3, -3, 1}).found();
        REQUIRE(left != right);
    }
    CHECK(undecided == 200);
}

TEST_CASE("Both sides are hit alike and barycentric weights give the point") {
    Uniforms random(2);
    int hits = 0;
    for (int i = 0; i < 200000; ++i) {
        const RandomTriangle t(random);
        const Vec3f target = t.point(random);
        const Vec3f from = random.cube(-3, 3);
        const Ray ray{.origin = from, .direction = target - from};
        const Hit front = hit_of(ray, t.a, t.b, t.c);
        const Hit back = hit_of(ray, t.a, t.c, t.b);
        REQUIRE(front.found() == back.found());
        if (!front.found()) continue;  // aimed at an edge, or along the plane
        ++hits;
        // Same terms, added in another order: three sums of numbers up to 6.
        REQUIRE(std::fabs(front.t - back.t) <= 4e-6f);
        REQUIRE(std::fabs(front.b1 - back.b2) <= 4e-6f);
        const float b0 = 1.0f - front.b1 - front.b2;
        REQUIRE(min_of(b0, min_of(front.b1, front.b2)) > -1e-6f);
        const Vec3d at{b0 * t.a + front.b1 * t.b + front.b2 * t.c};
        const Vec3d along = Vec3d{ray.origin} + static_cast<double>(front.t) * Vec3d{ray.direction};
        // The weights are off by 2 u L^2 over the area that the ray sees, and move the point by L times that.
        const Vec3d cross = glm::cross(Vec3d{t.b} - Vec3d{t.a}, Vec3d{t.c} - Vec3d{t.a});
        const double seen = std::fabs(glm::dot(cross, glm::normalize(Vec3d{ray.direction})));
        REQUIRE(glm::length(at - along) < 2.0 * 0x1p-24 * 42.0 / seen + 4e-6);
    }
    CHECK(hits > 190000);
}

TEST_CASE("Hits at equal distance go to the lowest number in any order") {
    Uniforms random(3);
    for (int i = 0; i < 100000; ++i) {
        const RandomTriangle t(random);
        const Vec3f target = t.point(random);
        const Vec3f from = random.cube(-3, 3);
        const Ray ray{.origin = from, .direction = target - from};
        const Hit rising = hit_of(ray, t.a, t.b, t.c, 9, hit_of(ray, t.a, t.b, t.c, 4));
        const Hit falling = hit_of(ray, t.a, t.b, t.c, 4, hit_of(ray, t.a, t.b, t.c, 9));
        REQUIRE(test::same_bits(rising, falling));
        if (rising.found()) REQUIRE(rising.primitive == 4);
    }
}

TEST_CASE("Distances are limited on both sides") {
    const Vec3f a{-1, -1, 2}, b{1, -1, 2}, c{0, 1, 2};
    Ray ray;  // along +z from 0
    CHECK(hit_of(ray, a, b, c).t == 2.0f);
    CHECK(hit_of(ray, a, b, c, 0, Hit{.t = 2.0f}).found());  // t_max itself is inside
    CHECK_FALSE(hit_of(ray, a, b, c, 0, Hit{.t = next_float_down(2.0f)}).found());
    ray.origin.z = 2.0f;  // on it: t = 0 is outside
    CHECK_FALSE(hit_of(ray, a, b, c).found());
    ray.origin.z = 3.0f;
    CHECK_FALSE(hit_of(ray, a, b, c).found());
    ray.direction.z = -4.0f;  // distances count in units of the direction
    CHECK(hit_of(ray, a, b, c).t == 0.25f);
}

TEST_CASE("Rays in the plane of a triangle give nothing that is not finite") {
    Uniforms random(4);
    int hits = 0;
    for (int i = 0; i < 1000000; ++i) {
        const RandomTriangle t(random);
        Ray ray;
        Vec3f a = t.a, b = t.b, c = t.c;
        if (i % 2 == 0) {  // exactly in the plane: both in a plane of coordinates
            const int axis = static_cast<int>(random.below(3));
            ray.origin = random.cube(-3, 3);
            ray.direction = random.direction();
            a[axis] = b[axis] = c[axis] = ray.origin[axis];
            ray.direction[axis] = 0.0f;
        } else {  // to rounding
            ray.origin = t.a + random.between(-2, 2) * (t.b - t.a);
            ray.direction = t.point(random) - ray.origin;
        }
        const Hit hit = hit_of(ray, a, b, c);
        if (!hit.found()) continue;
        ++hits;
        REQUIRE(hit.t < kInfinity);
        REQUIRE(hit.t > 0.0f);
        REQUIRE(std::fabs(hit.b1) <= 1.000001f);
        REQUIRE(std::fabs(hit.b2) <= 1.000001f);
    }
    INFO(hits << " hits by rounding");
    SUCCEED();
}

// Every direction of the 26 that have components 0 and +-1, with both signs of zero, at the corners, edges and inside.
TEST_CASE("Directions with zeros hit the right triangles") {
    const Vec3f corners[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    int tested = 0;
    for (int pattern = 0; pattern < 27; ++pattern)
        for (int zeros = 0; zeros < 8; ++zeros) {
            Vec3f d{static_cast<float>(pattern % 3 - 1), static_cast<float>(pattern / 3 % 3 - 1),
                    static_cast<float>(pattern / 9 - 1)};
            for (int axis = 0; axis < 3; ++axis)
                if (d[axis] == 0.0f && ((zeros >> axis) & 1) != 0) d[axis] = -0.0f;
            if (d.z == 0.0f) continue;  // in the plane, or no direction at all
            for (const Vec3f target :
                 {Vec3f{0.25f, 0.25f, 0}, Vec3f{0, 0, 0}, Vec3f{1, 0, 0}, Vec3f{0.5f, 0, 0}, Vec3f{0.5f, 0.5f, 0}}) {
                const Ray ray{.origin = target - 2.0f * d, .direction = d};
                const Hit hit = hit_of(ray, corners[0], corners[1], corners[2]);
                REQUIRE(hit.found());
                REQUIRE(hit.t == 2.0f);
                ++tested;
            }
            REQUIRE_FALSE(
                hit_of({.origin = Vec3f{1, 1, 0} - 2.0f * d, .direction = d}, corners[0], corners[1], corners[2])
                    .found());
        }
    CHECK(tested == 5 * 18 * 8);
}

TEST_CASE("Rays with a NaN or infinity or no direction hit nothing") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Uniforms random(5);
    SceneDescription description;
    description.materials.push_back(test::gray());
    test::add_spiky_sphere(description, 8, 8, 1.0f, 2.0f, 1);
    const HostScene scene = pack_scene(description);
    const BvhIntersector intersector{scene.view()};
    for (int i = 0; i < 100000; ++i) {
        Ray ray{.origin = random.cube(-1, 1), .direction = random.direction()};
        const float bad[] = {nan, kInfinity, -kInfinity};
        const float value = bad[random.below(3)];
        const std::uint32_t component = random.below(6);
        if (component < 3)
            ray.origin[static_cast<int>(component)] = value;
        else
            ray.direction[static_cast<int>(component - 3)] = value;
        REQUIRE_FALSE(test::closest_hit_by_all(scene.view(), ray).found());
        REQUIRE_FALSE(intersector.closest_hit(ray).found());
        REQUIRE_FALSE(intersector.occluded(ray));
    }
    CHECK_FALSE(intersector.closest_hit({.direction = Vec3f{0.0f}}).found());
    CHECK(intersector.closest_hit({}).found());
}

TEST_CASE("Triangles with two equal corners are never hit") {
    Uniforms random(6);
    for (int i = 0; i < 200000; ++i) {
        const RandomTriangle t(random);
        const Vec3f from = random.cube(-3, 3);
        const Ray ray{.origin = from, .direction = glm::mix(t.a, t.b, random.next()) - from};
        REQUIRE_FALSE(hit_of(ray, t.a, t.b, t.a).found());
        REQUIRE_FALSE(hit_of(ray, t.a, t.a, t.b).found());
        REQUIRE_FALSE(hit_of(ray, t.b, t.a, t.a).found());
        REQUIRE_FALSE(hit_of(ray, t.a, t.a, t.a).found());
    }
}
