// Lights near a surface: points uniform in solid angle, with the same density for hits, and little noise next to a lamp.
#include "core/kernel/shading/lights.h"

#include "tests/core/kernel/shading/light_density.h"
#include "tests/support/catch.hpp"
#include "tests/support/statistics/rules.h"

using namespace pl;
using namespace pl::test;

namespace {

/// A lamp of two triangles, 2 x 2, at this distance above the origin, next to a small one that is far for its size.
SceneDescription lamp_above(float distance) {
    SceneDescription scene;
    scene.materials = {gray()};
    scene.materials[0].emission = Vec3f{2.0f};
    add_triangle(scene, Vec3f{-1, -1, distance}, Vec3f{-1, 1, distance}, Vec3f{1, -1, distance}, 0);
    add_triangle(scene, Vec3f{1, 1, distance}, Vec3f{1, -1, distance}, Vec3f{-1, 1, distance}, 0);
    add_triangle(scene, Vec3f{5, 0, 0}, Vec3f{5, 0.1f, 0}, Vec3f{5, 0, 0.1f}, 0);
    return scene;
}

SurfacePoint floor_at_origin() {
    SurfacePoint point;
    point.geometric_normal = point.shading_normal = {0, 0, 1};
    return point;
}

}  // namespace

TEST_CASE("Near lights: only triangles that are large for their distance are sampled by solid angle") {
    const HostScene near_scene = pack_scene(lamp_above(0.5f));
    const HostScene far_scene = pack_scene(lamp_above(10.0f));
    const auto solid_angle = [](const HostScene& scene, std::uint32_t primitive) {
        return near_solid_angle(see_triangle(scene.view(), primitive, Vec3f{0.0f}));
    };
    CHECK(solid_angle(near_scene, 0) > 1.0f);
    CHECK(solid_angle(near_scene, 2) == 0.0f);
    CHECK(solid_angle(far_scene, 0) == 0.0f);
    // Seen edge on, and touched.
    CHECK(near_solid_angle(see_triangle(near_scene.view(), 0, Vec3f{1.5f, 0, 0.5f})) == 0.0f);
    CHECK(near_solid_angle(see_triangle(near_scene.view(), 0, Vec3f{-1, -1, 0.5f})) == 0.0f);
}

// As for far lights: the mean density over uniform directions times 4 pi. S1: seed 2, N = 4e6, resolves 1 %.
TEST_CASE("Near lights: the density of light samples integrates to one over directions") {
    for (const float distance : {0.05f, 0.5f, 1.5f}) {
        const HostScene scene = pack_scene(lamp_above(distance));
        CHECK(mean_equals(density_over_sphere(scene.view()), {1.0, 1e-4}, 0.03));
    }
}

TEST_CASE("Near lights: a sampled point has the density that a hit there has") {
    const HostScene packed = pack_scene(lamp_above(0.5f));
    const SceneView scene = packed.view();
    Uniforms random(5);
    for (int i = 0; i < 100000; ++i) {
        const Vec3f u{random.next(), random.next(), random.next()};
        const DirectLight sample = sample_direct_light(scene, floor_at_origin(), LambertBsdf{}, Vec4f{u, 0.0f});
        if (sample.pdf_sa == 0.0f) continue;
        REQUIRE(light_pdf_sa(scene, Vec3f{0.0f}, sample.light, sample.wi) == Approx(sample.pdf_sa).epsilon(1e-5));
    }
}

// The irradiance below the corner of a unit square of radiance L at distance d is L / r atan(1 / r) with r^2 = 1 + d^2; the lamp is
// four of them.
TEST_CASE("Near lights: light samples next to a lamp give its irradiance with little noise") {
    constexpr double d = 0.05;
    SceneDescription description = lamp_above(static_cast<float>(d));
    description.triangles.pop_back();
    const HostScene scene = pack_scene(description);
    const double root = std::sqrt(1.0 + d * d);
    const double irradiance = 2.0 * 4.0 * (1.0 / root) * std::atan(1.0 / root);
    Uniforms random(6);
    Moments moments;
    for (int i = 0; i < 100000; ++i) {
        const Vec3f u{random.next(), random.next(), random.next()};
        const DirectLight sample =
            sample_direct_light(scene.view(), floor_at_origin(), LambertBsdf{}, Vec4f{u, 0.0f});
        const bool is_seen = sample.pdf_sa > 0.0f;
        moments.add(is_seen ? static_cast<double>(sample.emitted.x * sample.cos_i / sample.pdf_sa) : 0.0);
    }
    CHECK(mean_equals(moments, {irradiance, 0.0}, 0.02));
    CHECK(moments.variance() < irradiance * irradiance);
}
