// Glass that absorbs: a slab in closed form, light that is sampled inside of glass, and no more light than there is.
#include "core/kernel/shading/absorption.h"

#include <cmath>

#include "core/kernel/geometry/intersector.h"
#include "core/kernel/integrator/trace_path.h"
#include "core/kernel/methods/default.h"
#include "core/scene/needed_effects.h"
#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr glm::vec3 kAbsorption{0.5f, 2.0f, 0.0f};

MaterialDescription glass(float ior) {
    return {.name = "glass", .kind = SurfaceKind::Dielectric, .ior = ior, .absorption = kAbsorption};
}

/// A wide slab of glass between z = 0 and z = thickness.
SceneDescription slab(float ior, float thickness) {
    SceneDescription scene;
    scene.materials = {glass(ior)};
    add_box(scene, Vec3f{-20, -20, 0}, Vec3f{20, 20, thickness}, false);
    return scene;
}

/// Mean of many paths along a ray, and its standard error, for each channel.
struct Mean {
    Vec3d value{0.0};
    Vec3d error{0.0};
};
Mean mean_along(const HostScene& packed, const Ray& ray, std::uint32_t paths, bool next_event = true) {
    const SceneView scene = packed.view();
    const PathSettings settings{.max_depth = 1000, .next_event = next_event ? 1u : 0u};
    Vec3d sum{0.0};
    Vec3d squares{0.0};
    for (std::uint32_t i = 0; i < paths; ++i) {
        PathState<kEveryFeature, DefaultMethod> state;
        state.ray = ray;
        state.pixel = i;
        PathCounters counters;
        trace_path<kEveryFeature>(PathContext<DefaultMethod>{scene, DefaultMethod{}, settings}, BvhIntersector{scene},
                                  state, counters);
        sum += Vec3d{state.radiance};
        squares += Vec3d{state.radiance} * Vec3d{state.radiance};
    }
    const Vec3d mean = sum / static_cast<double>(paths);
    return {mean, glm::sqrt(glm::max(squares / static_cast<double>(paths) - mean * mean, 0.0) /
                            static_cast<double>(paths))};
}

/// Reflected and transmitted share of a slab whose faces reflect R and whose inside lets a share t through along one way.
struct SlabShares {
    double reflected, transmitted;
};
SlabShares slab_shares(double r, double t) {
    const double series = 1.0 / (1.0 - r * r * t * t);
    return {r + (1.0 - r) * (1.0 - r) * r * t * t * series, (1.0 - r) * (1.0 - r) * t * series};
}

void check_mean(const Mean& mean, const Vec3d& expected) {
    for (int c = 0; c < 3; ++c) {
        CAPTURE(c, mean.value[c], mean.error[c], expected[c]);
        CHECK(mean.error[c] < 0.006 * (expected[c] + 0.01));
        CHECK(std::fabs(mean.value[c] - expected[c]) <
              4.0 * mean.error[c] + 3e-4 * expected[c]);  // rays begin above their surface
    }
}

}  // namespace

TEST_CASE("Light falls off exponentially, also over infinite distances") {
    CHECK(transmittance(0.0f, kInfinity) == 1.0f);
    CHECK(transmittance(0.0f, 5.0f) == 1.0f);
    CHECK(transmittance(1e-30f, kInfinity) == 0.0f);
    CHECK(transmittance(3.0f, 0.0f) == 1.0f);
    CHECK(transmittance(3.0f, 1e30f) == 0.0f);
    for (const float depth : {1e-6f, 0.1f, 1.0f, 10.0f, 80.0f})
        CHECK(transmittance(2.0f, 0.5f * depth) == Approx(std::exp(-static_cast<double>(depth))).epsilon(1e-5));
}

TEST_CASE("Only glass that absorbs needs the effect") {
    SceneDescription scene = slab(1.5f, 1.0f);
    CHECK(needed_effects(pack_scene(scene)) == features(Feature::Specular, Feature::Absorption));
    const std::uint64_t bytes = bytes_of(pack_scene(scene));
    scene.materials[0].absorption = glm::vec3(0.0f);
    CHECK(needed_effects(pack_scene(scene)) == features(Feature::Specular));
    CHECK(bytes_of(pack_scene(scene)) == bytes - sizeof(Vec3f));
    scene.materials[0].absorption = kAbsorption;
    scene.materials[0].kind = SurfaceKind::Plastic;
    CHECK_FALSE(needed_effects(pack_scene(scene)).has(Feature::Absorption));
}

// 100 000 paths each, within 4 standard errors (probability 6e-5 each); the power to find 5 % of a share is above 0.99.
TEST_CASE("A slab of glass lets through what Fresnel's and Beer's laws say") {
    for (const float ior : {1.0f, 1.5f, 2.4f}) {
        for (const double angle : {0.0, 0.6, 1.2}) {
            constexpr double kThickness = 0.7;
            const auto sine = static_cast<float>(std::sin(angle));
            const auto cosine = static_cast<float>(std::cos(angle));
            CAPTURE(ior, angle);
            SceneDescription scene = slab(ior, static_cast<float>(kThickness));
            // Above the slab the sky is dark: what is reflected does not count.
            add_triangle(scene, Vec3f{-90, -90, -3}, Vec3f{90, -90, -3}, Vec3f{0, 120, -3}, 1);
            scene.materials.push_back({.name = "lamp", .emission = glm::vec3(2.0f), .two_sided_emission = true});
            const Ray ray{.origin = {-2.0f * sine, 0, static_cast<float>(kThickness) + 2.0f * cosine},
                          .direction = {sine, 0, -cosine}};
            const double inside = std::sqrt(1.0 - std::pow(std::sin(angle) / static_cast<double>(ior), 2));
            const double r = static_cast<double>(fresnel_dielectric(cosine, ior));
            Vec3d expected;
            for (int c = 0; c < 3; ++c)
                expected[c] =
                    2.0 *
                    slab_shares(r, std::exp(-static_cast<double>(kAbsorption[c]) * kThickness / inside)).transmitted;
            check_mean(mean_along(pack_scene(scene), ray, 100000), expected);
        }
    }
}

TEST_CASE("A slab under an even sky reflects and lets through no more than there is") {
    SceneDescription scene = slab(1.5f, 0.7f);
    scene.environment = glm::vec3(1.0f);
    for (const float roughness : {0.0f, 0.5f}) {
        scene.materials[0].roughness = roughness;
        const Mean mean = mean_along(pack_scene(scene), {.origin = {0, 0, 2}, .direction = {0.6f, 0, -0.8f}}, 20000);
        CAPTURE(roughness, mean.value.x, mean.value.y, mean.value.z);
        CHECK(mean.value.z == Approx(1.0).epsilon(0.01));  // of blue nothing is absorbed
        CHECK(mean.value.x < 0.85);
        CHECK(mean.value.y < mean.value.x);
    }
}

// A lamp and a floor inside of glass of the index 1: light samples, and paths that find the lamp, see the same light.
TEST_CASE("Light samples inside of glass are absorbed along their shadow rays") {
    SceneDescription scene;
    scene.materials = {glass(1.0f), gray(), gray(0.0f)};
    scene.materials[1].albedo = glm::vec3(0.5f);
    scene.materials[2].emission = glm::vec3(4.0f);
    add_box(scene, Vec3f{-9, -15, -9}, Vec3f{9}, false);
    add_triangle(scene, Vec3f{-5, -5, 0}, Vec3f{5, -5, 0}, Vec3f{0, 6, 0}, 1);
    add_triangle(scene, Vec3f{-1, 1, 2}, Vec3f{1, 1, 2}, Vec3f{0, -1, 2}, 2);
    scene.punctual_lights = {{.kind = PunctualKind::Point, .position = {0, 0, 1.5f}, .intensity = glm::vec3(1.0f)}};
    const HostScene packed = pack_scene(scene);
    const Ray ray{.origin = {0, -20, 20}, .direction = glm::normalize(Vec3f{0, 1, -1})};
    const Mean sampled = mean_along(packed, ray, 100000);
    scene.punctual_lights.clear();
    const Mean found = mean_along(pack_scene(scene), ray, 100000, false);
    // The floor is 9 sqrt(2) behind the surface of the glass.
    Vec3d expected = found.value;
    for (int c = 0; c < 3; ++c) {
        const auto absorption = static_cast<double>(kAbsorption[c]);
        const double share = std::exp(-absorption * (9.0 * std::sqrt(2.0) + 1.5));
        expected[c] += 0.5 / 3.14159265358979323846 * share / (1.5 * 1.5);
        CAPTURE(c, sampled.value[c], sampled.error[c], found.error[c], expected[c]);
        CHECK(found.value[c] > 0.0);
        CHECK(std::fabs(sampled.value[c] - expected[c]) <
              4.0 * std::hypot(sampled.error[c], found.error[c]) + 1e-6 * expected[c]);
    }
}
