// The hierarchy gives the same bits as looking at every triangle, in scenes made to be hard for boxes.
#include <string_view>

#include "core/kernel/geometry/postponed_traversal.h"
#include "core/kernel/geometry/small_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/rays/brute_force.h"
#include "tests/support/rays/hard_rays.h"

using namespace pl;
using test::Uniforms;

namespace {

SmallScene small_scene(const SceneView& scene) {
    return {scene.bvh.nodes.data, scene.bvh.leaves.data, scene.bvh.triangles.data, scene.bvh.leaves.count};
}

/// Whether every traversal that serves a scene finds the expected hit, and whether there is one.
bool all_find(const SceneView& scene, const Ray& ray, const Hit& expected) {
    const auto finds = [&](const auto& hierarchy) {
        return test::same_bits(expected, find_hit(hierarchy, ray, false)) &&
               expected.found() == find_hit(hierarchy, ray, true).found();
    };
    return finds(scene.bvh) && finds(PostponingBvh{scene.bvh}) &&
           (scene.bvh.leaves.empty() || finds(small_scene(scene)));
}

/// Whether a hit is of a ray that misses the box of its triangle: all edge functions were rounding errors, see box_slack().
bool passes_beside(const SceneView& scene, const Ray& ray, const Hit& hit) {
    if (!hit.found()) return false;
    const Triangle& triangle = scene.triangles[hit.primitive];
    BvhNode box;
    for (const std::uint32_t corner : {triangle.v0, triangle.v1, triangle.v2}) {
        box.low = glm::min(box.low, scene.positions[corner]);
        box.high = glm::max(box.high, scene.positions[corner]);
    }
    return intersect_box(box, make_box_ray(scene.bvh.nodes[0], ray), hit.t) == kInfinity;
}

/// The first triangles of a scene.
SceneDescription first_triangles(SceneDescription scene, std::size_t count) {
    if (count < scene.triangles.size()) scene.triangles.resize(count);
    return scene;
}

void check_against_all(int rays, std::size_t most_triangles = 1000000) {
    for (const test::NamedShape& shape : test::hard_shapes()) {
        Uniforms random(11);
        SceneDescription description;
        description.materials.push_back(test::gray());
        shape.build(description, random);
        const HostScene packed = pack_scene(first_triangles(description, most_triangles));
        const SceneView scene = packed.view();
        CHECK(scene.bvh.leaves.empty() == (scene.triangles.count > kMostSmallTriangles));
        int hits = 0;
        int differences = 0;
        int beside = 0;
        for (int i = 0; i < rays; ++i) {
            const Ray ray = test::hard_ray(scene, random);
            const Hit expected = test::closest_hit_by_all(scene, ray);
            hits += expected.found() ? 1 : 0;
            if (all_find(scene, ray, expected)) continue;
            (passes_beside(scene, ray, expected) ? beside : differences) += 1;
        }
        INFO(shape.name);
        CHECK(differences == 0);
        CHECK(beside <= (shape.name == std::string_view("thin slivers") ? rays / 500000 : 0));
        CHECK(hits > rays / 20);
    }
}

/// A hit, and a box that the triangle test may have found it in: its distance from the box is as large as the derivation of
/// box_slack() allows.
struct BoxCase {
    BvhNode box;
    Ray ray;
    double t;
};

Vec3f hard_direction(Uniforms& random) {
    Vec3f direction = random.direction();
    for (int axis = 0; axis < 3; ++axis) {
        if (random.below(4) != 0) continue;
        const float sign = random.below(2) == 0 ? 1.0f : -1.0f;
        const float small[] = {0.0f, 1e-40f, std::exp2(-static_cast<float>(20 + random.below(40)))};
        direction[axis] = sign * small[random.below(3)];
    }
    if (direction == Vec3f{0.0f}) direction.y = 1.0f;
    return std::exp2(static_cast<float>(random.below(81)) - 40.0f) * direction;
}

/// The largest float that is not above x, or the smallest not below.
float rounded(double x, bool up) {
    const auto nearest = static_cast<float>(x);
    if (up) return static_cast<double>(nearest) < x ? next_float_up(nearest) : nearest;
    return static_cast<double>(nearest) > x ? next_float_down(nearest) : nearest;
}

BoxCase hard_box(Uniforms& random) {
    const auto scale = [&](std::uint32_t most) { return std::exp2(static_cast<float>(random.below(most)) - 8.0f); };
    BoxCase result;
    result.ray.origin = scale(24) * random.cube(-1, 1);
    if (random.below(8) == 0) result.ray.origin[static_cast<int>(random.below(3))] = 0.0f;
    result.ray.direction = hard_direction(random);
    result.ray.t_max = random.between(0.5f, 1.0f) * scale(24) / max_component(absolute(result.ray.direction));
    result.t = static_cast<double>(result.ray.t_max);
    const Vec3d moved = result.t * Vec3d{result.ray.direction};
    const double reach = glm::max(std::fabs(moved.x), glm::max(std::fabs(moved.y), std::fabs(moved.z)));
    const double off = 0.999 * 18.0 * static_cast<double>(kRoundoff) * reach;
    for (int axis = 0; axis < 3; ++axis) {
        const double x = static_cast<double>(result.ray.origin[axis]) + moved[axis];
        const float size = random.below(3) == 0 ? 0.0f : scale(12) * random.next();
        float& low = result.box.low[axis];
        float& high = result.box.high[axis];
        switch (random.below(3)) {
        case 0:
            low = rounded(x + off, false);
            high = low + size;
            break;
        case 1:
            high = rounded(x - off, true);
            low = high - size;
            break;
        default:
            low = rounded(x - static_cast<double>(size) * static_cast<double>(random.next()), false);
            high = rounded(x + static_cast<double>(size), true);
        }
    }
    return result;
}

/// How often the test misses a box by a slack of `share` times the present one, and the arithmetic of a back end.
template <class MultiplyAdd>
int missed_boxes(float share, MultiplyAdd multiply_add) {
    Uniforms random(5);
    int missed = 0;
    for (int i = 0; i < 200000; ++i) {
        const BoxCase hit = hard_box(random);
        const Vec3f reach = glm::max(absolute(hit.box.low - hit.ray.origin), absolute(hit.box.high - hit.ray.origin));
        const float origin = max_component(absolute(hit.ray.origin));
        const float slack = share * box_slack(max_component(reach), origin);
        const BoxRay ray = make_box_ray(hit.ray, max_component(reach) + origin, slack);
        missed += intersect_box(hit.box, ray, hit.ray.t_max, multiply_add) <= hit.ray.t_max ? 0 : 1;
    }
    return missed;
}

}  // namespace

TEST_CASE("No box with a hit is missed, by the roundings of host and device, and half the slack would not do") {
    const auto on_host = [](float a, float b, float c) { return bound_multiply_add(a, b, c); };
    // Fused and rounded down: one of the two floats around the exact value, here any one of two that bracket it.
    Uniforms random(6);
    const auto on_device = [&](float a, float b, float c) {
        const float nearest = std::fma(a, b, c);
        return random.below(2) == 0 ? nearest : next_float_down(nearest);
    };
    CHECK(missed_boxes(1.0f, on_host) == 0);
    CHECK(missed_boxes(1.0f, on_device) == 0);
    CHECK(missed_boxes(0.5f, on_host) > 100);
    CHECK(missed_boxes(0.5f, on_device) > 100);
}

TEST_CASE("Boxes pass where distances are beyond the range of numbers, and rays without a direction hit nothing") {
    BvhNode box;
    box.low = Vec3f{1e30f};
    box.high = Vec3f{2e30f};
    const Ray ray{.origin = Vec3f{-1e30f, 1.5e30f, 1.5e30f}, .direction = {1e-30f, 0.0f, 0.0f}};
    CHECK(intersect_box(box, make_box_ray(box, ray), kInfinity) == 0.0f);
    CHECK(can_hit(ray));
    CHECK_FALSE(can_hit({.origin = Vec3f{0.0f}, .direction = Vec3f{0.0f}}));
}

TEST_CASE("The hierarchy agrees with all triangles for 2e4 rays a scene") { check_against_all(20000); }

TEST_CASE("Every traversal of a small scene agrees with all triangles for 5e3 rays a scene") {
    for (const std::uint32_t most : {kMostSmallTriangles, kMostSmallTriangles / 2 + 1, 1u})
        check_against_all(5000, most);
}

TEST_CASE("The hierarchy agrees with all triangles for 1e6 rays a scene", "[nightly]") { check_against_all(1000000); }

TEST_CASE("An empty scene is missed") {
    const HostScene scene = pack_scene(SceneDescription{});
    CHECK(all_find(scene.view(), {}, {}));
}
