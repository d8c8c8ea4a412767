// Partial opacity: the number that decides over a hit is uniform and independent, and as many rays pass as the surface lets through.
#include "core/kernel/integrator/holes.h"

#include <array>

#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"
#include "tests/support/statistics/pairs.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr std::uint32_t kRays = 1u << 18;

Ray random_ray(Uniforms& random) {
    return {.origin = random.cube(-3, 5), .direction = glm::normalize(random.cube(-1, 1))};
}

/// Sheets across z, one behind the other, of these opacities.
SceneDescription sheets(std::initializer_list<float> opacities, OpacityRule rule) {
    SceneDescription scene;
    float z = 0.0f;
    for (const float opacity : opacities) {
        MaterialDescription material = gray();
        material.opacity = opacity;
        material.opacity_rule = rule;
        scene.materials.push_back(material);
        const auto index = static_cast<std::uint32_t>(scene.materials.size() - 1);
        z += 1.0f;
        add_triangle(scene, Vec3f{-9, -9, z}, Vec3f{9, -9, z}, Vec3f{0, 9, z}, index);
    }
    return scene;
}

/// From a small square on z = 0 upwards: all rays hit all sheets.
Ray ray_upwards(Uniforms& random) {
    return {.origin = {random.between(-1, 1), random.between(-1, 1), 0.0f},
            .direction = glm::normalize(Vec3f{random.between(-0.3f, 0.3f), random.between(-0.3f, 0.3f), 1.0f})};
}

}  // namespace

// Rule S3: seed 1, 2^18 rays, 256 bins; resolves 5 % of the density.
TEST_CASE("The number of a hit is uniform, and independent of that of a near ray or of the next triangle") {
    Uniforms random(1);
    Pairs next_triangle, near_origin, near_direction, turned, behind;
    for (std::uint32_t i = 0; i < kRays; ++i) {
        const Ray ray = random_ray(random);
        const std::uint32_t primitive = random.below(50);
        const float number = number_of_hit(ray, primitive);
        REQUIRE((number >= 0.0f && number < 1.0f));
        REQUIRE(number == number_of_hit(ray, primitive));
        next_triangle.add(number, number_of_hit(ray, primitive + 1));
        Ray other = ray;
        other.origin[static_cast<int>(i % 3)] = next_float_up(ray.origin[static_cast<int>(i % 3)]);
        near_origin.add(number, number_of_hit(other, primitive));
        other = ray;
        other.direction[static_cast<int>(i % 3)] = next_float_up(ray.direction[static_cast<int>(i % 3)]);
        near_direction.add(number, number_of_hit(other, primitive));
        turned.add(number, number_of_hit({.origin = ray.origin, .direction = -ray.direction}, primitive));
        behind.add(number,
                   number_of_hit({.origin = ray.origin + ray.direction, .direction = ray.direction}, primitive));
    }
    for (const Pairs& pairs : {next_triangle, near_origin, near_direction, turned, behind})
        CHECK(pairs.are_uniform());
}

// Rays through one pixel from one point, as a camera without a lens sends them: only low bits differ. S3 as above.
TEST_CASE("The numbers of hits within a pixel are uniform and independent of where in the pixel they are") {
    Uniforms random(2);
    Pairs across, next;
    float before = 0.5f;
    for (std::uint32_t i = 0; i < kRays; ++i) {
        const float x = random.next();
        const Vec3f direction = glm::normalize(Vec3f{0.2f + 1e-3f * x, 0.1f + 1e-3f * random.next(), -1.0f});
        const float number = number_of_hit({.origin = {0, 1, 2}, .direction = direction}, 7);
        across.add(x, number);
        next.add(before, number);
        before = number;
    }
    CHECK(across.are_uniform());
    CHECK(next.are_uniform());
}

// S1: seed 3, 2^18 rays; resolves 3 %. A share p of hits has the variance p (1 - p).
TEST_CASE("Sheets meet as many rays as their opacities say, shadow rays too") {
    const HostScene packed = pack_scene(sheets({0.25f, 0.5f, 1.0f}, OpacityRule::Blend));
    const SceneView scene = packed.view();
    const BvhIntersector intersector{scene};
    Uniforms random(3);
    std::array<Moments, 3> share;
    Moments unblocked;
    for (std::uint32_t i = 0; i < kRays; ++i) {
        const Ray ray = ray_upwards(random);
        const Hit hit = closest_solid_hit<kEveryFeature>(scene, intersector, ray);
        REQUIRE(hit.found());
        REQUIRE(hit.t * ray.direction.z == Approx(static_cast<float>(hit.primitive) + 1.0f));
        for (std::uint32_t k = 0; k < 3; ++k) share[k].add(hit.primitive == k ? 1.0 : 0.0);
        const Ray shadow{.origin = ray.origin, .direction = 2.5f * ray.direction, .t_max = 1.0f};
        unblocked.add(is_blocked<kEveryFeature>(scene, intersector, shadow) ? 0.0 : 1.0);
    }
    CHECK(mean_equals(share[0], {0.25}, 0.03));
    CHECK(mean_equals(share[1], {0.75 * 0.5}, 0.03));
    CHECK(mean_equals(share[2], {0.75 * 0.5}, 0.03));
    CHECK(mean_equals(unblocked, {0.75 * 0.5}, 0.03));
}

TEST_CASE("By the threshold a sheet is there or not, and so is one that blends at 0 and 1") {
    const auto first_of = [](std::initializer_list<float> opacities, OpacityRule rule) {
        const HostScene packed = pack_scene(sheets(opacities, rule));
        const BvhIntersector intersector{packed.view()};
        Uniforms random(4);
        std::uint32_t first = kNoPrimitive;
        for (int i = 0; i < 1000; ++i) {
            const Hit hit = closest_solid_hit<kEveryFeature>(packed.view(), intersector, ray_upwards(random));
            CHECK((i == 0 || hit.primitive == first));
            first = hit.primitive;
        }
        return first;
    };
    CHECK(first_of({0.49f, 0.5f, 1.0f}, OpacityRule::Threshold) == 1);
    CHECK(first_of({0.49f, 0.2f}, OpacityRule::Threshold) == kNoPrimitive);
    CHECK(first_of({0.0f, 1.0f, 0.5f}, OpacityRule::Blend) == 1);
}
