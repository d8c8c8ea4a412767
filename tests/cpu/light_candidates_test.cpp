// Lights that are sampled in SIMD lanes are those of the scalar code, bit for bit, by every instruction set.
#include "cpu/light_candidates.h"

#include <cstring>

#include "core/kernel/methods/default.h"
#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr FeatureSet kLights = FeatureSet{}.with(Feature::NextEventEstimation);
using Context = PathContext<DefaultMethod>;
using Point = ScatterPoint<kLights, DefaultMethod>;

/// A room with triangles that shine: small, large, edge-on, and one without area.
HostScene room_of_lights(int lights) {
    SceneDescription scene;
    scene.materials = {gray(), gray(0.3f)};
    scene.materials[1].emission = glm::vec3{3.0f, 2.0f, 1.0f};
    add_box(scene, Vec3f{-1.0f}, Vec3f{1.0f}, true);
    Uniforms random(3);
    for (int i = 0; i < lights; ++i) {
        const Vec3f corner = random.cube(-0.9f, 0.9f);
        const float size = std::exp2(-static_cast<float>(random.below(12)));
        const Vec3f last = i == 2 ? corner : corner + size * random.direction();
        add_triangle(scene, corner, corner + size * random.direction(), last, 1);
    }
    return pack_scene(scene);
}

/// A point on a surface, often on a light, seen from a random direction.
Point random_point(const SceneView& scene, Uniforms& random) {
    Vec3f b = random.cube(0.0f, 1.0f);
    b *= 1.0f / (b.x + b.y + b.z);
    const Vec3f wo = random.direction();
    Point point;
    point.surface = make_surface_point<kLights>(scene, random.below(scene.triangles.count), b, wo);
    point.bsdf = make_bsdf<kLights>(scene, point.surface, b, wo);
    return point;
}

Vec4f random_numbers(Uniforms& random) {
    const Vec3f u = random.cube(0.0f, 1.0f);
    return {u, random.next()};
}

bool same_bits(const Vec3f& a, const Vec3f& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

bool same_light(const UnweightedLight& a, const UnweightedLight& b) {
    return same_bits(a.ray.origin, b.ray.origin) && same_bits(a.ray.direction, b.ray.direction) &&
           a.ray.t_max == b.ray.t_max && a.ray.source == b.ray.source && a.ray.target == b.ray.target &&
           same_bits(a.wi, b.wi) && a.pdf_sa == b.pdf_sa && same_bits(a.contribution, b.contribution) &&
           same_bits(a.reflected, b.reflected) && a.irradiance == b.irradiance && a.cluster == b.cluster;
}

struct Comparison {
    int different = 0;
    int lit = 0;   ///< receivers whose sample can contribute
    int near = 0;  ///< of those, samples by solid angle
};

/// Blocks of every size up to the largest one.
Comparison compare(const Context& context, const LaneKernels& kernels) {
    Comparison result;
    LightCandidates<kLights, DefaultMethod> candidates(context, kernels);
    Uniforms random(5);
    for (std::uint32_t size = 0; size <= kGuidedBlock; ++size) {
        candidates.clear();
        std::vector<UnweightedLight> expected;
        for (std::uint32_t i = 0; i < size; ++i) {
            const Point point = random_point(context.scene, random);
            const Vec4f u = random_numbers(random);
            const ReceivedWeights weights{.throughput = random.cube(0.0f, 1.0f)};
            REQUIRE(candidates.takes(point, u));
            candidates.add(i, point, u, weights);
            expected.push_back(sample_light(context, point, u, weights));
        }
        candidates.sample();
        REQUIRE(candidates.count() == size);
        for (std::uint32_t i = 0; i < size; ++i) {
            result.different += candidates.path(i) == i && same_light(candidates.light(i), expected[i]) ? 0 : 1;
            result.lit += expected[i].pdf_sa > 0.0f ? 1 : 0;
            result.near += candidates.is_near(i) ? 1 : 0;
        }
    }
    return result;
}

}  // namespace

TEST_CASE("Every instruction set samples the lights of the scalar code, bit for bit") {
    for (const int lights : {1, 3, 20}) {
        const HostScene scene = room_of_lights(lights);
        const SceneView view = scene.view();
        REQUIRE(view.light_tree.empty());
        const DefaultMethod method;
        const PathSettings settings{.next_event = 1};
        const Context context{view, method, settings};
        for (const LaneKernels& kernels : usable_lane_kernels()) {
            INFO(kernels.isa << ", " << lights << " lights");
            const Comparison result = compare(context, kernels);
            CHECK(result.different == 0);
            CHECK(result.lit > 150);
            CHECK(result.near > 50);
        }
    }
}

TEST_CASE("Lanes leave lights of a tree, and the lights of a scene without any, to the scalar code") {
    SceneDescription dark;
    dark.materials = {gray()};
    add_box(dark, Vec3f{-1.0f}, Vec3f{1.0f}, true);
    const HostScene unlit = pack_scene(dark);
    const HostScene many = room_of_lights(3000);
    REQUIRE_FALSE(many.view().light_tree.empty());
    for (const HostScene* scene : {&unlit, &many}) {
        const SceneView view = scene->view();
        const DefaultMethod method;
        const PathSettings settings{.next_event = 1};
        const Context context{view, method, settings};
        Uniforms random(6);
        CHECK_FALSE(LightCandidates<kLights, DefaultMethod>(context).takes(random_point(view, random),
                                                                           random_numbers(random)));
    }
}
