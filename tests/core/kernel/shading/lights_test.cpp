// Choosing points on lights: frequencies, densities per area and per solid angle, and weights between strategies.
#include "core/kernel/shading/lights.h"

#include "tests/core/kernel/shading/light_density.h"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.h"
#include "tests/support/scenes/shapes.h"
#include "tests/support/statistics/sampling_rule.h"

using namespace pl;
using namespace pl::test;

namespace {

/// Three lights of different size and brightness around the origin, facing it.
SceneDescription three_lights() {
    SceneDescription scene;
    scene.materials = {gray(), gray(), gray()};
    scene.materials[0].emission = {1, 2, 3};
    scene.materials[1].emission = {10, 0, 0};
    scene.materials[2].emission = {0, 0, 0.5f};
    add_triangle(scene, Vec3f{-1, 2, -1}, Vec3f{1, 2, -1}, Vec3f{0, 2, 1}, 0);
    add_triangle(scene, Vec3f{3, -0.2f, 0}, Vec3f{3, 0, 0.3f}, Vec3f{3, 0.2f, 0}, 1);
    add_triangle(scene, Vec3f{-4, -4, 3}, Vec3f{0, 4, 3}, Vec3f{4, -4, 3}, 2);
    return scene;
}

/// A horizontal surface at the origin, looking up the z axis.
SurfacePoint receiver(Vec3f normal = {0, 0, 1}) {
    SurfacePoint point;
    point.geometric_normal = point.shading_normal = normal;
    return point;
}

}  // namespace

// S3: 3 lights x 16 similar parts of each triangle; N = 2e6: densities off by 1 % are found.
TEST_CASE("Points on lights are chosen by area and luminance and uniformly in each") {
    const HostScene packed = pack_scene(three_lights());
    const SceneView scene = packed.view();
    REQUIRE(scene.lights.count == 3);
    std::vector<double> expected;
    double total = 0.0;
    for (const Light& light : scene.lights) {
        const Triangle& t = scene.triangles[light.primitive];
        const double area =
            0.5 * static_cast<double>(glm::length(glm::cross(scene.positions[t.v1] - scene.positions[t.v0],
                                                             scene.positions[t.v2] - scene.positions[t.v0])));
        const Material& material = scene.materials[t.material];
        total += area * static_cast<double>(light_pdf_area(scene, material));
        for (int part = 0; part < 16; ++part)
            expected.push_back(area * static_cast<double>(luminance(material.emission)) / 16.0);
    }
    CHECK(total == Approx(1.0));
    std::vector<std::uint64_t> counts(expected.size());
    Uniforms random(1);
    for (int i = 0; i < 2000000; ++i) {
        const Vec3f u{random.next(), random.next(), random.next()};
        const std::uint32_t light = choose_light(scene, u.x);
        const SurfacePoint point = sample_light(scene, {}, u).surface;
        REQUIRE(point.primitive == scene.lights[light].primitive);
        const Vec2f b = 4.0f * square_to_triangle({u.y, u.z});
        const int column = min_of(static_cast<int>(b.x), 3);
        const int row = min_of(static_cast<int>(b.y), 3 - column);
        const bool upper = b.x - static_cast<float>(column) + b.y - static_cast<float>(row) > 1.0f;
        const int part = 16 - (4 - row) * (4 - row) + 2 * column + (upper && row + column < 3 ? 1 : 0);
        ++counts[light * 16 + static_cast<std::uint32_t>(part)];
    }
    CHECK(sampler_matches(counts, expected, 0.01));
}

// The density per steradian integrates to 1 over all directions. Each light fills a known share of the sphere, so this
// is a mean over uniform directions. S1: seed 2, N = 4e6, resolves 1 %.
TEST_CASE("The density of light samples integrates to one over directions") {
    const HostScene packed = pack_scene(three_lights());
    const SceneView scene = packed.view();
    CHECK(mean_equals(density_over_sphere(scene), {1.0, 1e-4}, 0.03));
}

TEST_CASE("Every number chooses a light and zero-width ones never") {
    SceneDescription description;
    description.materials = {gray(), gray()};
    description.materials[0].emission = Vec3f{1.0f};
    description.materials[1].emission = Vec3f{1e-30f};  // vanishes in the sum
    for (const std::uint32_t material : {1u, 0u, 1u, 0u, 1u}) {
        const auto z = static_cast<float>(description.triangles.size());
        add_triangle(description, Vec3f{0, 0, z}, Vec3f{1, 0, z}, Vec3f{0, 1, z}, material);
    }
    const HostScene scene = pack_scene(description);
    REQUIRE(scene.lights.size() == 5);
    const auto chosen = [&](float u) { return choose_light(scene.view(), u); };
    CHECK(chosen(0.0f) <= 1);
    CHECK(chosen(0.25f) == 1);
    CHECK(chosen(next_float_down(0.5f)) == 1);
    CHECK(chosen(0.5f) == 3);
    CHECK(chosen(kAlmostOne) == 3);
}

TEST_CASE("Light samples that cannot contribute have no density") {
    SceneDescription description;
    description.materials.push_back(gray());
    description.materials[0].emission = Vec3f{1.0f};
    add_triangle(description, Vec3f{-1, -1, 2}, Vec3f{0, 1, 2}, Vec3f{1, -1, 2});  // its front looks down
    const auto sample = [&](const SurfacePoint& surface) {
        const HostScene scene = pack_scene(description);
        return sample_direct_light(scene.view(), surface, LambertBsdf{}, {0.3f, 0.4f, 0.5f, 0.0f});
    };
    CHECK(sample(receiver()).pdf_sa > 0.0f);
    CHECK(sample(receiver()).light.front);
    CHECK(sample(receiver({0, 0, -1})).pdf_sa == 0.0f);  // faces away
    SurfacePoint above = receiver({0, 0, -1});
    above.position = {0, 0, 4};
    CHECK(sample(above).pdf_sa == 0.0f);  // sees the dark back
    SurfacePoint in_plane = receiver({1, 0, 0});
    in_plane.position = {-5, 0, 2};
    CHECK(sample(in_plane).pdf_sa == 0.0f);  // edge on
    SurfacePoint itself = receiver();
    itself.primitive = 0;
    CHECK(sample(itself).pdf_sa == 0.0f);
    description.materials[0].two_sided_emission = true;
    CHECK(sample(above).pdf_sa > 0.0f);
    CHECK_FALSE(sample(above).light.front);

    description.materials[0].emission = Vec3f{0.0f};
    CHECK(sample(receiver()).pdf_sa == 0.0f);  // no light at all
}

// Estimates of the irradiance below a small light against area * cos * cos / distance^2.
TEST_CASE("A light sample weighed by its density gives the light of a distant patch") {
    SceneDescription description;
    description.materials.push_back(gray());
    description.materials[0].emission = Vec3f{3.0f};
    constexpr float s = 1e-3f;
    add_triangle(description, Vec3f{1, 0, 1}, Vec3f{1, s, 1}, Vec3f{1 + s, 0, 1});  // its front looks down
    const HostScene scene = pack_scene(description);
    Uniforms random(3);
    for (int i = 0; i < 1000; ++i) {
        const Vec3f u{random.next(), random.next(), random.next()};
        const DirectLight light = sample_direct_light(scene.view(), receiver(), LambertBsdf{}, Vec4f{u, 0.0f});
        const double estimate = static_cast<double>(light.emitted.x * light.cos_i / light.pdf_sa);
        const double area = 0.5 * static_cast<double>(s) * static_cast<double>(s);
        REQUIRE(std::fabs(estimate / (3.0 * area * 0.5 / 2.0) - 1.0) < 4e-3);  // the patch spans 1e-3 of the distance
    }
}

TEST_CASE("Weights of two strategies add up to one for all densities") {
    Uniforms random(4);
    for (int i = 0; i < 1000000; ++i) {
        const float a = std::pow(10.0f, random.between(-30, 30));
        const float b = std::pow(10.0f, random.between(-30, 30));
        const float sum = balance_weight(a, b) + balance_weight(b, a);
        if (!(std::fabs(sum - 1.0f) <= 4.0f * kRoundoff)) FAIL(a << " and " << b << " give " << sum);
    }
    CHECK(balance_weight(1.0f, 0.0f) == 1.0f);
    CHECK(balance_weight(0.0f, 1.0f) == 0.0f);
    CHECK(balance_weight(0.0f, 0.0f) == 0.0f);
    CHECK(balance_weight(1.0f, kInfinity) == 0.0f);
    CHECK(balance_weight(1e20f, 1e20f) == 0.5f);
    CHECK(balance_weight(3e38f, 3e38f) == 0.5f);
}
