// SIMD lanes sample the lights of the scalar code, bit for bit, by every instruction set.
#include "cpu/paths/light_block.h"

#include <memory>

#include "core/kernel/integrator/sampled_lights.h"
#include "core/kernel/methods/default.h"
#include "tests/cpu/put_vertex.h"
#include "tests/cpu/room_of_lights.h"
#include "tests/support/catch.hpp"

using namespace pl;
using namespace pl::test;

namespace {

constexpr FeatureSet kLights = kRoomEffects;

/// Default path tracing that keeps the estimates it is told of.
struct KeepsEstimates : DefaultMethod {
    using Light = LightEstimate;

    Light light_sampled(auto&, const auto&, const LightEstimate& estimate) const { return estimate; }
    void record_light(const Light&, bool) const {}
};
using Context = PathContext<KeepsEstimates>;
using LitPoint = ScatterPoint<kLights, KeepsEstimates>;

/// The light sample of one path alone, weighed.
ShadowRequest<KeepsEstimates> request_alone(const Context& context, const LitPoint& point, Vec4f u,
                                            Vec3f throughput) {
    PathState<kLights, KeepsEstimates> state;
    state.throughput = throughput;
    ShadowRequest<KeepsEstimates> shadow;
    request_light(context, point, u, state, shadow);
    return shadow;
}

bool same_light(const LightBlock<kLights, KeepsEstimates>& block, std::uint32_t i, const LitPoint& point,
                const ShadowRequest<KeepsEstimates>& alone) {
    if (block.is_wanted(i) != alone.wanted) return false;
    if (!alone.wanted) return true;
    const LightEstimate estimate = block.estimate(i, Vec3f{1.0f});
    return same_ray(block.shadow_ray(i, point.surface.primitive), alone.ray) &&
           same_bits(block.contribution(i), alone.contribution) &&
           same_bits(estimate.reflected, alone.light.reflected) && estimate.irradiance == alone.light.irradiance &&
           estimate.cluster == alone.light.cluster;
}

struct Comparison {
    int different = 0;
    int lit = 0;    ///< vertices whose sample can contribute
    int near = 0;   ///< vertices whose sample of a light by solid angle can contribute
    int delta = 0;  ///< vertices whose sample of a delta light can contribute
    int far = 0;    ///< vertices whose sample of a far light can contribute; in rooms without directional lights
};

/// In rooms without an environment.
bool is_of_delta_light(const Ray& shadow) {
    return shadow.target == kDeltaLightTarget || shadow.target == kNoPrimitive;
}

bool is_of_near_light(const SceneView& scene, const SurfacePoint& surface,
                      const ShadowRequest<KeepsEstimates>& shadow) {
    return shadow.wanted && shadow.ray.target < scene.direct_triangles() &&
           near_solid_angle(see_triangle(scene, shadow.ray.target, Receiver::of(surface).origin)) > 0.0f;
}

/// Blocks of every size up to the largest one.
Comparison compare(const Context& context, const LaneKernels& kernels) {
    Comparison result;
    const auto block = std::make_unique<VertexBlock<kLights, KeepsEstimates>>();
    const LightTable table(context.scene);
    const auto lights = std::make_unique<LightBlock<kLights, KeepsEstimates>>(context, &table, kernels);
    DirectionGroup directions[kBlockGroups];
    Uniforms random(5);
    for (std::uint32_t size = 0; size <= kPathBlock; ++size) {
        block->clear(size);
        block->set_reached(first_bits(size));
        std::vector<LitPoint> points;
        std::vector<ShadowRequest<KeepsEstimates>> expected;
        for (std::uint32_t i = 0; i < size; ++i) {
            const RoomPoint at = random_point(context.scene, random);
            points.push_back({at.surface, at.bsdf});
            const Vec4f u = random_numbers(random);
            const Vec3f throughput = random.cube(0.0f, 1.0f);
            put_vertex(*block, i, points.back(), {.light = u}, throughput);
            expected.push_back(request_alone(context, points.back(), u, throughput));
        }
        lights->sample(*block);
        kernels.weigh_lambert(block->groups(), lights->groups(), directions, block->group_count());
        lights->weigh(*block, directions);
        for (std::uint32_t i = 0; i < size; ++i) {
            result.different += same_light(*lights, i, points[i], expected[i]) ? 0 : 1;
            result.lit += expected[i].wanted ? 1 : 0;
            result.delta += expected[i].wanted && is_of_delta_light(expected[i].ray) ? 1 : 0;
            result.far += expected[i].wanted && expected[i].ray.target == kNoPrimitive ? 1 : 0;
            result.near += is_of_near_light(context.scene, points[i].surface, expected[i]) ? 1 : 0;
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
        const KeepsEstimates method;
        const PathSettings settings{.next_event = 1};
        const Context context{view, method, settings};
        for (const LaneKernels& kernels : usable_lane_kernels()) {
            INFO(kernels.isa << ", " << lights << " lights");
            const Comparison result = compare(context, kernels);
            CHECK(result.different == 0);
            CHECK(result.lit > 150);
            CHECK(result.delta == 0);
        }
    }
}

TEST_CASE("Lights that are sampled by solid angle are sampled in lanes as by one path alone") {
    SceneDescription description = describe_room(3);
    add_triangle(description, Vec3f{-0.9f, 0.8f, -0.9f}, Vec3f{0.9f, 0.8f, -0.9f}, Vec3f{-0.9f, 0.8f, 0.9f}, 1);
    add_triangle(description, Vec3f{0.9f, 0.8f, 0.9f}, Vec3f{-0.9f, 0.8f, 0.9f}, Vec3f{0.9f, 0.8f, -0.9f}, 1);
    const HostScene scene = pack_scene(description);
    const SceneView view = scene.view();
    const KeepsEstimates method;
    const PathSettings settings{.next_event = 1};
    const Context context{view, method, settings};
    for (const LaneKernels& kernels : usable_lane_kernels()) {
        INFO(kernels.isa);
        const Comparison result = compare(context, kernels);
        CHECK(result.different == 0);
        CHECK(result.near > 500);
        CHECK(result.lit > result.near + 50);
    }
}

TEST_CASE("Delta lights beside those in the lanes are sampled as by one path alone") {
    for (const int lights : {0, 3, 20}) {
        const HostScene scene = room_of_lights(lights, delta_lights());
        for (const bool next_event : {false, true}) {
            const SampledScene sampled = with_delta_lights(scene.view(), {.next_event = next_event ? 1u : 0u});
            const KeepsEstimates method;
            const Context context{sampled.scene, method, sampled.path};
            for (const LaneKernels& kernels : usable_lane_kernels()) {
                INFO(kernels.isa << ", " << lights << " lights, next event " << next_event);
                const Comparison result = compare(context, kernels);
                CHECK(result.different == 0);
                CHECK(result.delta > 150);
                if (lights == 0 || !next_event)
                    CHECK(result.lit == result.delta);
                else
                    CHECK(result.lit > result.delta + 10);
            }
        }
    }
}

TEST_CASE("Far lights are sampled in lanes as by one path alone, beside all other lights") {
    struct Sky {
        const char* name;
        EnvironmentMapDescription map;
        SunDescription sun;
    };
    const Sky skies[] = {{"map", spotted_map(), {}},
                         {"sun", {}, wide_sun()},
                         {"map and sun", spotted_map(), wide_sun()},
                         {"one texel", {.width = 1, .height = 1, .texels = {glm::vec3{0.001f}}}, {}},
                         {"bright", {.width = 1, .height = 1, .texels = {glm::vec3{100.0f}}}, {}}};
    for (const Sky& sky : skies)
        for (const int lights : {0, 3}) {
            SceneDescription description = describe_room(lights);
            description.environment_map = sky.map;
            description.sun = sky.sun;
            const HostScene scene = pack_scene(description);
            const SceneView view = scene.view();
            CAPTURE(view.far_probability);
            REQUIRE(view.far_probability > 0.0f);
            const KeepsEstimates method;
            const PathSettings settings{.next_event = 1};
            const Context context{view, method, settings};
            for (const LaneKernels& kernels : usable_lane_kernels()) {
                INFO(kernels.isa << ", " << sky.name << ", " << lights << " lights");
                const Comparison result = compare(context, kernels);
                CHECK(result.different == 0);
                CHECK(result.far > 200);
                if (lights == 0) CHECK(result.lit == result.far);
                if (view.far_probability < 0.9f) CHECK(result.lit > result.far + 20);
            }
        }
}

TEST_CASE("Delta lights leave far lights to one path alone") {
    SceneDescription description = describe_room(3, delta_lights());
    description.environment_map = spotted_map();
    const HostScene scene = pack_scene(description);
    const SceneView view = scene.view();
    const KeepsEstimates method;
    const PathSettings settings{.next_event = 1};
    for (const LaneKernels& kernels : usable_lane_kernels()) {
        const Comparison result = compare({view, method, settings}, kernels);
        CHECK(result.different == 0);
        CHECK(result.far > 100);
    }
}

TEST_CASE("Lights at surfaces with lobes are the samples that were made in lanes") {
    constexpr FeatureSet kLobes = kLights.with(Feature::Plastic);
    SceneDescription description = describe_room(3);
    description.materials[0].kind = SurfaceKind::Plastic;
    description.environment_map = spotted_map();
    description.sun = wide_sun();
    const HostScene scene = pack_scene(description);
    const SceneView view = scene.view();
    const DefaultMethod method;
    const PathSettings settings{.next_event = 1};
    const PathContext<DefaultMethod> context{view, method, settings};
    const LightTable table(view);
    for (const LaneKernels& kernels : usable_lane_kernels()) {
        const auto block = std::make_unique<VertexBlock<kLobes, DefaultMethod>>();
        const auto lights = std::make_unique<LightBlock<kLobes, DefaultMethod>>(context, &table, kernels);
        Uniforms random(9);
        int far = 0;
        int triangles = 0;
        for (int round = 0; round < 20; ++round) {
            block->clear(kPathBlock);
            block->set_reached(first_bits(kPathBlock));
            std::vector<UnweightedLight> expected;
            for (std::uint32_t i = 0; i < kPathBlock; ++i) {
                const SurfacePoint surface = random_point(view, random).surface;
                const Vec4f u = random_numbers(random);
                const ScatterPoint<kLobes, DefaultMethod> point{
                    surface, make_bsdf<kLobes>(view, surface, Vec3f{1.0f / 3.0f}, surface.geometric_normal)};
                expected.push_back(sample_light(context, point, u, {}));
                put_vertex(*block, i, point, {.light = u});
            }
            lights->sample(*block);
            for (std::uint32_t i = 0; i < kPathBlock; ++i) {
                if (!block->is_layered(i)) continue;
                const UnweightedLight light = lights->sample_layered(*block, i, {});
                REQUIRE(light.pdf_sa == expected[i].pdf_sa);
                if (!(light.pdf_sa > 0.0f)) continue;
                REQUIRE(same_ray(light.ray, expected[i].ray));
                REQUIRE(same_bits(light.contribution, expected[i].contribution));
                (light.ray.target == kNoPrimitive ? far : triangles) += 1;
            }
        }
        INFO(kernels.isa);
        CHECK(far > 200);
        CHECK(triangles > 50);
    }
}

TEST_CASE("Lights inside of glass that absorbs are sampled as by one path alone") {
    constexpr FeatureSet kGlass = kLights.with(Feature::Specular).with(Feature::Absorption);
    constexpr std::uint32_t kInk = 2;
    const HostScene scene = room_of_lights(
        3, delta_lights(), {.name = "ink", .kind = SurfaceKind::Dielectric, .absorption = {0.5f, 2.0f, 0.0f}});
    const SceneView view = scene.view();
    const DefaultMethod method;
    const PathSettings settings{.next_event = 1};
    const PathContext<DefaultMethod> context{view, method, settings};
    const auto block = std::make_unique<VertexBlock<kGlass, DefaultMethod>>();
    const LightTable table(view);
    const auto lights = std::make_unique<LightBlock<kGlass, DefaultMethod>>(context, &table);
    Uniforms random(8);
    int lit = 0;
    int absorbed = 0;
    for (int round = 0; round < 20; ++round) {
        block->clear(kPathBlock);
        block->set_reached(first_bits(kPathBlock));
        std::vector<UnweightedLight> expected;
        for (std::uint32_t i = 0; i < kPathBlock; ++i) {
            const SurfacePoint surface = random_point(view, random).surface;
            const ScatterPoint<kGlass, DefaultMethod> point{
                surface, make_bsdf<kGlass>(view, surface, Vec3f{1.0f / 3.0f}, surface.geometric_normal)};
            const Vec4f u = random_numbers(random);
            const std::uint32_t medium = random.below(2) == 0 ? kInk : kNoMedium;
            put_vertex(*block, i, point, {.light = u});
            block->set_medium(i, medium);
            expected.push_back(sample_light(context, point, u, {.medium = medium}));
            const UnweightedLight outside = sample_light(context, point, u, {});
            absorbed += expected.back().irradiance < outside.irradiance ? 1 : 0;
        }
        lights->sample(*block);
        for (std::uint32_t i = 0; i < kPathBlock; ++i) {
            REQUIRE(lights->is_wanted(i) == (expected[i].pdf_sa > 0.0f));
            if (!lights->is_wanted(i)) continue;
            ++lit;
            const LightSampleGroup& group = lights->groups()[i / kGroupSize];
            const std::uint32_t lane = i % kGroupSize;
            CHECK(rms(group.emitted.get(lane)) * (kInvPi * group.cos_i[lane]) == expected[i].irradiance);
        }
    }
    CHECK(lit > 200);
    CHECK(absorbed > 100);
}

TEST_CASE("A scene without lights has no light samples") {
    SceneDescription dark;
    dark.materials = {gray()};
    add_box(dark, Vec3f{-1.0f}, Vec3f{1.0f}, true);
    const HostScene scene = pack_scene(dark);
    const SceneView view = scene.view();
    const KeepsEstimates method;
    const PathSettings settings{.next_event = 1};
    const Context context{view, method, settings};
    const auto block = std::make_unique<VertexBlock<kLights, KeepsEstimates>>();
    const LightTable table(view);
    const auto lights = std::make_unique<LightBlock<kLights, KeepsEstimates>>(context, &table);
    Uniforms random(7);
    block->clear(1);
    block->set_reached(1);
    const RoomPoint at = random_point(view, random);
    put_vertex(*block, 0, LitPoint{at.surface, at.bsdf}, {.light = random_numbers(random)});
    lights->sample(*block);
    CHECK_FALSE(lights->is_wanted(0));
}
