// Choosing among many lights: frequencies and probabilities, bounds that never lose a light, and the gain in noise.
#include "core/kernel/shading/light_tree.h"

#include "core/scene/needed_effects.h"
#include "core/scene/pack_steps.h"
#include "tests/core/kernel/shading/light_density.h"
#include "tests/support/catch.hpp"
#include "tests/support/shading/many_lights.h"
#include "tests/support/statistics/sampling_rule.h"

using namespace pl;
using namespace pl::test;

namespace {

/// Lights on a sphere around the origin that face it: none hides another.
SceneDescription shell() {
    SceneDescription scene;
    scene.materials.assign(7, gray());
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        scene.materials[i].emission = Vec3f{static_cast<float>(1 + 3 * i)};
    Uniforms random(8);
    for (std::uint32_t i = 0; i < 60; ++i) {
        const float height = -0.95f + 1.9f * static_cast<float>(i) / 59.0f;
        const float around = 2.399963f * static_cast<float>(i);
        const float r = std::sqrt(1.0f - height * height);
        const Vec3f out{r * std::cos(around), height, r * std::sin(around)};
        const Vec3f side = glm::normalize(glm::cross(out, Vec3f{0.3f, 0.5f, 0.8f}));
        const Vec3f up = glm::cross(side, out);
        const Vec3f center = random.between(1.0f, 4.0f) * out;
        const float size = 0.28f * glm::length(center);
        add_triangle(scene, center, center + size * up, center + size * side, i % 7);
    }
    return scene;
}

double sum_of_probabilities(const LightTree& tree, Vec3f from) {
    double sum = 0.0;
    for (std::uint32_t light = 0; light < tree.of_light.count; ++light)
        sum += static_cast<double>(light_probability(tree, light, from));
    return sum;
}

/// Cumulative probabilities of a tree's clusters: cluster i weighs `weight(i)`.
template <class Weight>
std::vector<float> choice_of(const LightTree& tree, Weight weight) {
    std::vector<float> cdf;
    for (std::uint32_t i = 0; i < tree.clusters.count; ++i)
        cdf.push_back((cdf.empty() ? 0.0f : cdf.back()) + weight(i));
    for (float& value : cdf) value /= cdf.back();
    return cdf;
}

}  // namespace

TEST_CASE("Every light is in one cluster, below the root of that cluster") {
    for (const std::uint32_t lights : {33u, 40u, 200u}) {
        SceneDescription scene = scattered_lights();
        scene.triangles.resize(lights);
        const HostScene packed = pack_scene(scene);
        const LightTree tree = packed.view().light_tree;
        REQUIRE(tree.clusters.count == kMostLightClusters);
        std::vector<int> found(lights);
        for (std::uint32_t cluster = 0; cluster < tree.clusters.count; ++cluster) {
            CHECK(tree.nodes[tree.clusters[cluster]].cluster == cluster);
            const auto visit = [&](const auto& self, std::uint32_t node) -> void {
                if (tree.nodes[node].is_leaf != 0) {
                    ++found[tree.nodes[node].next];
                    CHECK(tree.of_light[tree.nodes[node].next].cluster == cluster);
                    return;
                }
                self(self, node + 1);
                self(self, tree.nodes[node].next);
            };
            visit(visit, tree.clusters[cluster]);
        }
        CHECK(found == std::vector<int>(lights, 1));
    }
}

// S3: N = 1e6 each: probabilities off by 2 % are found.
TEST_CASE("Lights are chosen as often as the mixture of a learned choice and the tree says") {
    const HostScene packed = pack_scene(scattered_lights());
    const LightTree tree = packed.view().light_tree;
    const std::vector<float> one = choice_of(tree, [](std::uint32_t i) { return i == 17 ? 1.0f : 0.0f; });
    const std::vector<float> many =
        choice_of(tree, [](std::uint32_t i) { return i % 3 == 0 ? 0.0f : 1.0f * static_cast<float>(i); });
    for (const std::vector<float>& cdf : {one, many})
        for (const Vec3f from : {Vec3f{0.0f}, Vec3f{-50, 3, 3}}) {
            const LearnedLights learned{cdf.data()};
            std::vector<double> expected;
            double sum = 0.0;
            for (std::uint32_t light = 0; light < kLights; ++light) {
                expected.push_back(static_cast<double>(light_probability(tree, light, from, learned)));
                sum += expected.back();
                CHECK(expected.back() >=
                      0.999 * static_cast<double>(kTreeShare * light_probability(tree, light, from)));
            }
            CHECK(sum == Approx(1.0).epsilon(1e-5));
            std::vector<std::uint64_t> counts(kLights);
            Uniforms random(1);
            for (int i = 0; i < 1000000; ++i) {
                const ChosenLight chosen = choose_light(tree, from, random.next(), learned);
                ++counts[chosen.light];
                if (chosen.probability != light_probability(tree, chosen.light, from, learned))
                    FAIL("light " << chosen.light);
            }
            CHECK(sampler_matches(counts, expected, 0.02));
        }
}

// S3: 200 lights seen from four points inside and outside; N = 1e6 each: probabilities off by 2 % are found.
TEST_CASE("Lights of a tree are chosen as often as their probabilities say") {
    const HostScene packed = pack_scene(scattered_lights());
    const LightTree tree = packed.view().light_tree;
    REQUIRE(tree.of_light.count == kLights);
    for (const Vec3f from : {Vec3f{0.0f}, Vec3f{1.5f, -1, 0.3f}, Vec3f{0, 0, 7}, Vec3f{-50, 3, 3}}) {
        std::vector<double> expected;
        for (std::uint32_t light = 0; light < kLights; ++light)
            expected.push_back(static_cast<double>(light_probability(tree, light, from)));
        CHECK(sum_of_probabilities(tree, from) == Approx(1.0).epsilon(1e-5));
        std::vector<std::uint64_t> counts(kLights);
        Uniforms random(1);
        for (int i = 0; i < 1000000; ++i) {
            const ChosenLight chosen = choose_light(tree, from, random.next());
            ++counts[chosen.light];
            // One rule for both strategies: their weights add up to 1.
            if (chosen.probability != light_probability(tree, chosen.light, from)) FAIL("light " << chosen.light);
        }
        CHECK(sampler_matches(counts, expected, 0.02));
    }
}

// As for few lights. S1: seed 2, N = 4e6, resolves 3 %.
TEST_CASE("The density of samples of many lights integrates to one over directions") {
    const HostScene packed = pack_scene(shell());
    const SceneView scene = packed.view();
    REQUIRE_FALSE(scene.light_tree.empty());
    CHECK(mean_equals(density_over_sphere<kMany>(scene), {1.0, 1e-4}, 0.03));
}

// S1: seed 9, N = 1e6, resolves 3 %; the sum over a grid is good to 1e-3.
TEST_CASE("Irradiance from many lights does not depend on how they are chosen, but its noise does") {
    const HostScene packed = pack_scene(scattered_lights());
    const SceneView scene = packed.view();
    for (const Vec3f position : {Vec3f{0.2f, 0.1f, 0.0f}, Vec3f{1.9f, 1.7f, -1.8f}}) {
        const SurfacePoint surface = receiver_at(position, {0, 1, 0});
        const Moments by_power = irradiance<FeatureSet{}>(scene, surface, 1000000);
        const Moments by_tree = irradiance<kMany>(scene, surface, 1000000);
        const double expected = summed_irradiance(scene, surface);
        CHECK(mean_equals(by_power, {expected, 1e-3 * expected}, 0.05));
        CHECK(mean_equals(by_tree, {expected, 1e-3 * expected}, 0.03));
        INFO("variance " << by_power.variance() << " by power, " << by_tree.variance() << " by the tree");
        CHECK(by_tree.variance() < 0.85 * by_power.variance());
    }
}

// A hundred equal lamps in a row: a handful is near any point. By power, each would get a hundredth of the samples.
TEST_CASE("Below a long row of lamps the near ones get the samples") {
    SceneDescription row;
    row.materials.push_back(gray());
    row.materials[0].emission = Vec3f{1.0f};
    for (int i = 0; i < 100; ++i) {
        const auto x = static_cast<float>(i);
        add_triangle(row, Vec3f{x, 1, 0}, Vec3f{x + 0.1f, 1, 0}, Vec3f{x, 1, 0.1f});
    }
    const HostScene packed = pack_scene(row);
    const SurfacePoint surface = receiver_at({41.3f, 0, 0}, {0, 1, 0});
    const Moments by_power = irradiance<FeatureSet{}>(packed.view(), surface, 100000);
    const Moments by_tree = irradiance<kMany>(packed.view(), surface, 100000);
    INFO("variance " << by_power.variance() << " by power, " << by_tree.variance() << " by the tree");
    CHECK(by_tree.variance() < 0.05 * by_power.variance());
}

// A node with parts of the dome and a lamp has the size of the dome: the lamps get a tenth of their share where the tree mixes them.
TEST_CASE("A dome around lamps leaves them their share of the samples") {
    SceneDescription scene;
    scene.materials = {gray(), gray()};
    scene.materials[0].emission = Vec3f{0.3f};
    scene.materials[1].emission = Vec3f{9.0f};
    add_spiky_sphere(scene, 16, 32, 100.0f, 100.0f, 1);
    for (const float x : {-3.0f, 1.0f})
        add_quad(scene, add_vertex(scene, {x, 5, 0}), add_vertex(scene, {x + 2, 5, 0}),
                 add_vertex(scene, {x + 2, 5, 1}), add_vertex(scene, {x, 5, 1}), 1);
    const HostScene packed = pack_scene(scene);
    const SceneView view = packed.view();
    const SurfacePoint surface = receiver_at({0.5f, 0, 1}, {0, 1, 0});
    const double irradiance_of_dome = 0.3 * 3.141592653589793;
    const double share = 1.0 - irradiance_of_dome / summed_irradiance(view, surface);
    double chosen = 0.0;
    for (std::uint32_t light = view.lights.count - 4; light < view.lights.count; ++light)
        chosen += static_cast<double>(light_probability(view.light_tree, light, surface.position));
    INFO("share " << share << ", chosen " << chosen);
    CHECK(share > 0.3);
    CHECK(chosen > 0.5 * share);
    CHECK(chosen < 2.0 * share);
}

// Every corner of a light that sees a point with its front bounds the light from below.
TEST_CASE("No light that shines on a point is ever left out") {
    const HostScene packed = pack_scene(scattered_lights());
    const SceneView scene = packed.view();
    Uniforms random(3);
    for (int i = 0; i < 2000; ++i) {
        const Vec3f from = random.cube(-3, 3);
        for (std::uint32_t light = 0; light < kLights; ++light) {
            const std::uint32_t primitive = scene.lights[light].primitive;
            const Triangle& t = scene.triangles[primitive];
            const float height = glm::dot(scene.planes[primitive].normal, from - scene.positions[t.v0]);
            const bool shines = height > 1e-4f || scene.materials[t.material].two_sided_emission != 0;
            if (shines && !(light_probability(scene.light_tree, light, from) > 0.0f))
                FAIL("light " << light << " from " << from.x << ' ' << from.y << ' ' << from.z);
        }
    }
}

TEST_CASE("Probabilities of lights do not depend on the unit of length") {
    const HostScene packed = pack_scene(scattered_lights());
    const LightTree tree = packed.view().light_tree;
    const Vec3f from{0.3f, -0.7f, 2.1f};
    for (const float scale : {0x1p-20f, 0x1p20f}) {
        const HostScene other = pack_scene(scattered_lights(scale));
        for (std::uint32_t light = 0; light < kLights; ++light)
            REQUIRE(light_probability(other.view().light_tree, light, scale * from) ==
                    light_probability(tree, light, from));
    }
}

TEST_CASE("Lights in one place, points on them and points far away have probabilities that add up to one") {
    SceneDescription pile;
    pile.materials.push_back(gray());
    pile.materials[0].emission = Vec3f{1.0f};
    for (int i = 0; i < 40; ++i) add_triangle(pile, Vec3f{0, 0, 0}, Vec3f{1, 0, 0}, Vec3f{0, 1, 0});
    const HostScene packed = pack_scene(pile);
    const LightTree tree = packed.view().light_tree;
    for (const Vec3f from : {Vec3f{0.5f, 0.5f, 0}, Vec3f{0, 0, 0}, Vec3f{0.3f, 0.3f, -5}, Vec3f{1e15f, 0, 1e15f},
                             Vec3f{3e19f, 3e19f, 3e19f}, Vec3f{5, 0, 0}})
        CHECK(sum_of_probabilities(tree, from) == Approx(1.0).epsilon(1e-5));
}

TEST_CASE("Few lights have no tree, and none is an effect that is needed") {
    SceneDescription few;
    few.materials.push_back(gray());
    few.materials[0].emission = Vec3f{1.0f};
    for (std::size_t i = 0; i < kFewLights; ++i)
        add_triangle(few, Vec3f{0, 0, static_cast<float>(i)}, Vec3f{1, 0, 0}, Vec3f{0, 1, 0});
    const HostScene packed = pack_scene(few);
    CHECK(packed.light_nodes.empty());
    CHECK(packed.light_places.empty());
    CHECK_FALSE(needed_effects(packed).has(Feature::ManyLights));
    add_triangle(few, Vec3f{0, 1, 0}, Vec3f{1, 0, 2}, Vec3f{0, 1, 3});
    CHECK(needed_effects(pack_scene(few)).has(Feature::ManyLights));
}
