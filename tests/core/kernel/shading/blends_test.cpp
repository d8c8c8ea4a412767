// Blended materials: the number that chooses is uniform and independent, and materials are chosen by their shares.
#include "core/kernel/shading/blends.h"

#include <array>

#include "core/kernel/integrator/holes.h"
#include "core/kernel/shading/bsdf.h"
#include "core/scene/needed_effects.h"
#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"
#include "tests/support/statistics/pairs.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr std::uint32_t kArrivals = 1u << 18;

struct Arrival {
    Hit hit;
    Ray ray;
    Vec3f b{0.0f};
    Vec3f wo{0.0f};
};

/// A random ray that hits the only triangle of a scene anywhere.
Arrival random_arrival(Uniforms& random) {
    const Vec2f u = random.square();
    const float root = std::sqrt(u.x);
    const Hit hit{.t = 1.0f, .primitive = 0, .b1 = root * u.y, .b2 = 1.0f - root};
    const Vec3f up = random.cube(-1, 1);
    const Vec3f wo = glm::normalize(Vec3f{up.x, up.y, std::fabs(up.z) + 0.01f});
    return {hit, {.origin = random.cube(-3, 5), .direction = -wo}, hit_weights(hit), wo};
}

/// A triangle that blends three materials: 0.4 of the first, the rest by halves times an image of 0.5; their albedos are 0.1, 0.2, 0.3.
SceneDescription chain_of_three() {
    SceneDescription scene;
    scene.materials = {gray(0.1f), gray(0.2f), gray(0.3f)};
    scene.materials[0].blend = {.other = 1, .share = 0.6f};
    scene.materials[1].blend = {.other = 2, .share = 0.5f};
    scene.materials[1].textures.blend = 0;
    scene.textures = {{.width = 1, .height = 1, .texels = {{0.5f, 0.9f, 0.1f, 1.0f}}}};
    add_triangle(scene, Vec3f{0, 0, 0}, Vec3f{1, 0, 0}, Vec3f{0, 1, 0});
    return scene;
}

}  // namespace

// Rule S3: seed 1, 2^18 arrivals, 256 bins; resolves 5 % of the density.
TEST_CASE(
    "The number of a choice is uniform, and independent of that of a near point, of the next choice and of holes") {
    Uniforms random(1);
    Pairs next_triangle, near_point, near_direction, next_choice, hole;
    for (std::uint32_t i = 0; i < kArrivals; ++i) {
        const Arrival arrival = random_arrival(random);
        const std::uint32_t primitive = random.below(50);
        const MaterialPoint point{.material = 3, .primitive = primitive, .triangle = primitive, .b = arrival.b};
        const float number = number_of_choice(point, arrival.wo, 0);
        REQUIRE((number >= 0.0f && number < 1.0f));
        MaterialPoint other = point;
        other.material = 5;
        REQUIRE(number == number_of_choice(other, arrival.wo, 0));
        ++other.primitive;
        next_triangle.add(number, number_of_choice(other, arrival.wo, 0));
        other = point;
        other.b[1 + static_cast<int>(i % 2)] = next_float_up(point.b[1 + static_cast<int>(i % 2)]);
        near_point.add(number, number_of_choice(other, arrival.wo, 0));
        Vec3f turned = arrival.wo;
        turned[static_cast<int>(i % 3)] = next_float_up(turned[static_cast<int>(i % 3)]);
        near_direction.add(number, number_of_choice(point, turned, 0));
        next_choice.add(number, number_of_choice(point, arrival.wo, 1 + i % (kMostBlends - 1)));
        hole.add(number, number_of_hit(arrival.ray, point.primitive));
    }
    for (const Pairs& pairs : {next_triangle, near_point, near_direction, next_choice, hole})
        CHECK(pairs.are_uniform());
}

// S1: seed 2, 2^18 arrivals. A share p of arrivals has the variance p (1 - p); the smallest is resolved to 6 %.
TEST_CASE("Materials of a blend are chosen by their shares, times the image, and decide the BSDF") {
    const HostScene packed = pack_scene(chain_of_three());
    REQUIRE(needed_effects(packed) == features(Feature::Blends, Feature::Textures));
    const SceneView scene = packed.view();
    Uniforms random(2);
    std::array<Moments, 3> share;
    for (std::uint32_t i = 0; i < kArrivals; ++i) {
        const Arrival arrival = random_arrival(random);
        const SurfacePoint surface = make_surface_point<kEveryFeature>(scene, arrival.hit, arrival.wo);
        const std::uint32_t material = shown_material<kEveryFeature>(scene, surface, arrival.b, arrival.wo).material;
        for (std::uint32_t m = 0; m < 3; ++m) share[m].add(m == material ? 1.0 : 0.0);
        const auto bsdf = make_bsdf<kEveryFeature>(scene, surface, arrival.b, arrival.wo);
        REQUIRE(bsdf.albedo() == packed.materials[material].albedo);
        REQUIRE(surface.material == 0);
        REQUIRE(shown_material<FeatureSet{}>(scene, surface, arrival.b, arrival.wo).material == 0);
    }
    CHECK(mean_equals(share[0], {0.4}, 0.03));
    CHECK(mean_equals(share[1], {0.6 * 0.75}, 0.03));
    CHECK(mean_equals(share[2], {0.6 * 0.25}, 0.06));
}

TEST_CASE("A share of 0 is never chosen, one of 1 always") {
    for (const float share : {0.0f, 1.0f}) {
        SceneDescription description = chain_of_three();
        description.materials[0].blend.share = share;
        description.materials[1].blend = {};
        const HostScene packed = pack_scene(description);
        CHECK(packed.blends.empty() == (share == 0.0f));
        Uniforms random(3);
        for (int i = 0; i < 10000; ++i) {
            const Arrival arrival = random_arrival(random);
            const SurfacePoint surface = make_surface_point<kEveryFeature>(packed.view(), arrival.hit, arrival.wo);
            REQUIRE(shown_material<kEveryFeature>(packed.view(), surface, arrival.b, arrival.wo).material ==
                    (share == 0.0f ? 0u : 1u));
        }
    }
}

// Directions would be scattered to one side more than to another if the choice depended on them.
TEST_CASE("The mean direction of arrivals is the same for each material of a blend") {
    const HostScene packed = pack_scene(chain_of_three());
    Uniforms random(4);
    Moments chosen, other;
    for (std::uint32_t i = 0; i < kArrivals; ++i) {
        const Arrival arrival = random_arrival(random);
        const SurfacePoint surface = make_surface_point<kEveryFeature>(packed.view(), arrival.hit, arrival.wo);
        const bool is_first =
            shown_material<kEveryFeature>(packed.view(), surface, arrival.b, arrival.wo).material == 0;
        (is_first ? chosen : other).add(static_cast<double>(1.0f + arrival.wo.x));
    }
    CHECK(mean_equals(chosen, {1.0}, 0.02));
    CHECK(mean_equals(other, {1.0}, 0.02));
}
