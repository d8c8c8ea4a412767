// Lights without extent: the irradiance of a Lambert reflector in closed form, their shadow rays, and their share of the light samples.
#include "core/kernel/shading/delta_lights.h"

#include <algorithm>
#include <cmath>

#include "core/kernel/geometry/intersector.h"
#include "core/kernel/integrator/sampled_lights.h"
#include "core/kernel/integrator/trace_path.h"
#include "core/kernel/methods/default.h"
#include "core/scene/needed_effects.h"
#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.h"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

namespace {

/// A large floor in the plane z = 0 with the reflectance 1/2.
SceneDescription floor_with(std::vector<PunctualLightDescription> lights) {
    SceneDescription scene;
    scene.materials = {gray()};
    scene.materials[0].albedo = glm::vec3(0.5f);
    add_triangle(scene, Vec3f{-40, -40, 0}, Vec3f{40, -40, 0}, Vec3f{0, 60, 0}, 0);
    scene.punctual_lights = std::move(lights);
    return scene;
}

PunctualLightDescription point_light(glm::vec3 position, glm::vec3 intensity) {
    return {.kind = PunctualKind::Point, .position = position, .intensity = intensity};
}
PunctualLightDescription spot_light(SpotFalloff falloff) {
    return {.kind = PunctualKind::Spot,
            .position = {0, 0, 2},
            .direction = {0, 0, -3},
            .intensity = {8, 4, 2},
            .inner_deg = 20,
            .outer_deg = 50,
            .falloff = falloff};
}
PunctualLightDescription directional_light(glm::vec3 direction, glm::vec3 irradiance) {
    return {.kind = PunctualKind::Directional, .direction = direction, .intensity = irradiance};
}

/// Radiance of one path that looks straight down at the point (x, 0, 0).
Vec3f seen_at(const HostScene& packed, float x, std::uint32_t sample, bool next_event) {
    const PathSettings settings{.next_event = next_event ? 1u : 0u};
    const SampledScene sampled = with_delta_lights(packed.view(), settings);
    PathState<kEveryFeature, DefaultMethod> state;
    state.ray = {.origin = {x, 0, 1}, .direction = {0, 0, -1}};
    state.pixel = sample;
    PathCounters counters;
    trace_path<kEveryFeature>(PathContext<DefaultMethod>{sampled.scene, DefaultMethod{}, sampled.path},
                              BvhIntersector{sampled.scene}, state, counters);
    return state.radiance;
}

/// RedMean of many paths, and its standard error, of the red channel.
struct RedMean {
    double value = 0.0;
    double error = 0.0;
};
RedMean mean_at(const HostScene& packed, float x, bool next_event) {
    constexpr int kPaths = 200000;
    double sum = 0.0;
    double squares = 0.0;
    for (std::uint32_t i = 0; i < kPaths; ++i) {
        const auto red = static_cast<double>(seen_at(packed, x, i, next_event).x);
        sum += red;
        squares += red * red;
    }
    const double mean = sum / kPaths;
    return {mean, std::sqrt((squares / kPaths - mean * mean) / kPaths)};
}

/// Reflected radiance at (x, 0, 0) for a light at height 2 of this intensity in the direction of the point.
double by_height_2(double x, double intensity) {
    const double distance2 = x * x + 4.0;
    return 0.5 / kHalfTurn * intensity * 2.0 / (distance2 * std::sqrt(distance2));
}

}  // namespace

TEST_CASE("A point light gives I cos / d^2, with and without light samples of other lights") {
    const HostScene packed = pack_scene(floor_with({point_light({0, 0, 2}, {8, 4, 2})}));
    CHECK(needed_effects(packed) == features(Feature::DeltaLights));
    CHECK(packed.delta_probability == 1.0f);
    for (const bool next_event : {false, true}) {
        for (const float x : {0.0f, 0.5f, 3.0f}) {
            const Vec3f radiance = seen_at(packed, x, 0, next_event);
            CHECK(radiance.x == Approx(by_height_2(static_cast<double>(x), 8.0)).epsilon(1e-5));
            CHECK(radiance.y == Approx(0.5f * radiance.x).epsilon(1e-5));
            CHECK(radiance.z == Approx(0.25f * radiance.x).epsilon(1e-5));
        }
    }
}

TEST_CASE("A directional light gives E cos from any distance, and nothing from below") {
    const HostScene packed = pack_scene(floor_with({directional_light({3, 0, -4}, {2, 1, 0})}));
    const Vec3f radiance = seen_at(packed, 1.0f, 0, true);
    CHECK(radiance.x == Approx(0.5 / kHalfTurn * 2.0 * 0.8).epsilon(1e-5));
    CHECK(radiance.z == 0.0f);
    const HostScene below = pack_scene(floor_with({directional_light({0, 0, 1}, {2, 1, 0})}));
    CHECK(is_black(seen_at(below, 1.0f, 0, true)));
    const HostScene grazing = pack_scene(floor_with({directional_light({1, 0, 0}, {2, 1, 0})}));
    CHECK(is_black(seen_at(grazing, 1.0f, 0, true)));
}

TEST_CASE("A spot falls off by the cosine as glTF describes it, or by the angle as Mitsuba does") {
    const double inner = 20.0 * kHalfTurn / 180.0;
    const double outer = 50.0 * kHalfTurn / 180.0;
    const HostScene by_cosine = pack_scene(floor_with({spot_light(SpotFalloff::Cosine)}));
    const HostScene by_angle = pack_scene(floor_with({spot_light(SpotFalloff::Angle)}));
    for (const double angle : {0.0, 0.3, 0.5, 0.7, 0.85}) {
        const auto x = static_cast<float>(2.0 * std::tan(angle));
        CAPTURE(angle);
        const double share =
            std::clamp((std::cos(angle) - std::cos(outer)) / (std::cos(inner) - std::cos(outer)), 0.0, 1.0);
        const double linear = std::clamp((outer - angle) / (outer - inner), 0.0, 1.0);
        const double full = by_height_2(static_cast<double>(x), 8.0);
        CHECK(seen_at(by_cosine, x, 0, true).x == Approx(full * share * share).epsilon(1e-4));
        CHECK(seen_at(by_angle, x, 0, true).x == Approx(full * linear).epsilon(1e-4));
    }
    CHECK(is_black(seen_at(by_cosine, 2.5f, 0, true)));
    CHECK(is_black(seen_at(by_angle, 2.5f, 0, true)));
}

// 200 000 paths, seed 1: within 4 standard errors (probability 6e-5 each); the power to find 5 % is above 0.99.
TEST_CASE("Many delta lights together with a sky give the sum of their light") {
    std::vector<PunctualLightDescription> lights;
    double expected = 0.0;
    constexpr float x = 0.5f;
    for (int i = 0; i < 70; ++i) {
        const auto place = static_cast<float>(i % 7) - 3.0f;
        lights.push_back(point_light({x + place, 0, 2}, glm::vec3(0.1f + 0.01f * static_cast<float>(i))));
        expected += by_height_2(static_cast<double>(place), static_cast<double>(lights.back().intensity.x));
    }
    lights.push_back(directional_light({0, 0, -1}, glm::vec3(1.0f)));
    expected += 0.5 / kHalfTurn;
    SceneDescription scene = floor_with(lights);
    scene.environment_map = {
        .source = {}, .width = 2, .height = 1, .rotation_deg = 0.0f, .texels = {glm::vec3(0.5f), glm::vec3(0.5f)}};
    expected += 0.5 * 0.5;
    const HostScene packed = pack_scene(scene);
    CHECK(packed.far_probability + packed.delta_probability == 1.0f);
    for (const bool next_event : {false, true}) {
        const RedMean mean = mean_at(packed, x, next_event);
        CAPTURE(next_event, mean.value, mean.error, expected);
        CHECK(mean.error < 0.006 * expected);
        CHECK(std::fabs(mean.value - expected) < 4.0 * mean.error + 1e-4 * expected);
    }
}

TEST_CASE("A triangle between light and surface casts a shadow, one behind the light none") {
    SceneDescription scene = floor_with({point_light({0, 0, 2}, glm::vec3(8.0f))});
    add_triangle(scene, Vec3f{-9, -9, 3}, Vec3f{9, -9, 3}, Vec3f{0, 9, 3}, 0);
    CHECK(seen_at(pack_scene(scene), 0.0f, 0, false).x > 0.0f);
    add_triangle(scene, Vec3f{-9, -9, 1.5f}, Vec3f{9, -9, 1.5f}, Vec3f{0, 9, 1.5f}, 0);
    CHECK(is_black(seen_at(pack_scene(scene), 0.0f, 0, false)));
    scene.punctual_lights = {directional_light({0, 0, -1}, glm::vec3(1.0f))};
    CHECK(is_black(seen_at(pack_scene(scene), 0.0f, 0, false)));
}

TEST_CASE("Lights on and next to a surface give finite light") {
    for (const float height : {0.0f, 1e-30f, 1e-20f, 1e-10f, 1e-5f, -1.0f}) {
        const HostScene packed = pack_scene(floor_with({point_light({0, 0, height}, glm::vec3(1e6f))}));
        for (std::uint32_t i = 0; i < 100; ++i) CHECK(is_valid_radiance(seen_at(packed, 0.0f, i, true)));
    }
}

TEST_CASE("A cone without a width that numbers tell is dark, not invalid") {
    PunctualLightDescription needle = spot_light(SpotFalloff::Cosine);
    needle.inner_deg = 0.0f;
    needle.outer_deg = 1e-7f;
    for (const float x : {0.0f, 1e-6f, 1.0f}) CHECK(is_black(seen_at(pack_scene(floor_with({needle})), x, 0, true)));
}

TEST_CASE("Black lights and scenes without lights change nothing") {
    const HostScene none = pack_scene(floor_with({}));
    const HostScene black = pack_scene(floor_with({point_light({0, 0, 1}, glm::vec3(0.0f))}));
    CHECK(black.delta_lights.empty());
    CHECK(bytes_of(black) == bytes_of(none));
    CHECK(needed_effects(black) == FeatureSet{});
    const SampledScene sampled = with_delta_lights(none.view(), {});
    CHECK(sampled.path.next_event == 0u);
}
