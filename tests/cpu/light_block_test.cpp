// Lights that are sampled in SIMD lanes are those of the scalar code, bit for bit, by every instruction set.
#include "cpu/light_block.h"

#include <cstring>
#include <memory>

#include "core/kernel/integrator/sampled_lights.h"
#include "core/kernel/methods/default.h"
#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr FeatureSet kLights = features(Feature::NextEventEstimation, Feature::DeltaLights);

/// Default path tracing that keeps the estimates it is told of.
struct KeepsEstimates : DefaultMethod {
    using Light = LightEstimate;

    Light light_sampled(auto&, const auto&, const LightEstimate& estimate) const { return estimate; }
    void record_light(const Light&, bool) const {}
};
using Context = PathContext<KeepsEstimates>;
using Point = ScatterPoint<kLights, KeepsEstimates>;

/// A point, a spot and a directional light.
std::vector<PunctualLightDescription> delta_lights() {
    return {
        {.kind = PunctualKind::Point, .position = {0.2f, 0.4f, -0.3f}, .intensity = {3, 2, 1}},
        {.kind = PunctualKind::Spot, .position = {0, 0.9f, 0}, .direction = {0.1f, -1, 0.2f}, .intensity = {1, 2, 3}},
        {.kind = PunctualKind::Directional, .direction = {1, -2, 0.5f}, .intensity = {0.5f, 1, 0.2f}}};
}

/// A room with triangles that shine: small, large, edge-on, and one without area.
/// `third`: material number 2, of no triangle.
HostScene room_of_lights(int lights, std::vector<PunctualLightDescription> without_extent = {},
                         MaterialDescription third = {}) {
    SceneDescription scene;
    scene.punctual_lights = std::move(without_extent);
    scene.materials = {gray(), gray(0.3f), std::move(third)};
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

bool same_ray(const Ray& a, const Ray& b) {
    return same_bits(a.origin, b.origin) && same_bits(a.direction, b.direction) && a.t_max == b.t_max &&
           a.source == b.source && a.target == b.target;
}

/// The light sample of one path alone, weighed.
ShadowRequest<KeepsEstimates> request_alone(const Context& context, const Point& point, Vec4f u, Vec3f throughput) {
    PathState<kLights, KeepsEstimates> state;
    state.throughput = throughput;
    ShadowRequest<KeepsEstimates> shadow;
    request_light(context, point, u, state, shadow);
    return shadow;
}

bool same_light(const LightBlock<kLights, KeepsEstimates>& block, std::uint32_t i, const Point& point,
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
    int near = 0;   ///< vertices whose light may be sampled by solid angle
    int delta = 0;  ///< vertices whose sample of a delta light can contribute
};

/// In rooms without an environment.
bool is_of_delta_light(const Ray& shadow) {
    return shadow.target == kDeltaLightTarget || shadow.target == kNoPrimitive;
}

/// Blocks of every size up to the largest one.
Comparison compare(const Context& context, const LaneKernels& kernels) {
    Comparison result;
    const auto block = std::make_unique<VertexBlock<kLights, KeepsEstimates>>();
    const LightTable table(context.scene);
    const auto lights = std::make_unique<LightBlock<kLights, KeepsEstimates>>(context, table, kernels);
    DirectionGroup directions[kBlockGroups];
    Uniforms random(5);
    for (std::uint32_t size = 0; size <= kPathBlock; ++size) {
        block->clear();
        std::vector<Point> points;
        std::vector<ShadowRequest<KeepsEstimates>> expected;
        for (std::uint32_t i = 0; i < size; ++i) {
            points.push_back(random_point(context.scene, random));
            const Vec4f u = random_numbers(random);
            const Vec3f throughput = random.cube(0.0f, 1.0f);
            block->add(i, points.back(), {.throughput = throughput}, {.light = u});
            expected.push_back(request_alone(context, points.back(), u, throughput));
        }
        lights->sample(*block);
        kernels.weigh_lambert(block->groups(), lights->groups(), directions, block->group_count());
        lights->weigh(*block, directions);
        for (std::uint32_t i = 0; i < size; ++i) {
            result.different += same_light(*lights, i, points[i], expected[i]) ? 0 : 1;
            result.lit += expected[i].wanted ? 1 : 0;
            result.delta += expected[i].wanted && is_of_delta_light(expected[i].ray) ? 1 : 0;
            result.near += lights->groups()[i / kGroupSize].is_near[i % kGroupSize] != 0 ? 1 : 0;
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
            CHECK(result.near > 50);
            CHECK(result.delta == 0);
        }
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

namespace {

constexpr FeatureSet kMany = kLights.with(Feature::ManyLights).with(Feature::Rough);

/// Default path tracing with a learned choice of lights: that of a volume, or none.
struct ChoosesLights : DefaultMethod {
    static constexpr bool kLearnsLights = true;

    struct Vertex : DefaultMethod::Vertex {
        std::int32_t volume = kNoVolume;
    };
    struct {
        Span<const float> light_cdf;
    } field;
    std::uint32_t clusters = 0;

    Vertex locate(const SurfacePoint&, MethodCounters&) const { return {}; }
    LearnedLights learned_lights(const Vertex& vertex) const {
        if (vertex.volume == kNoVolume) return {};
        return {field.light_cdf.data + static_cast<std::uint32_t>(vertex.volume) * clusters};
    }
};

/// Cumulative probabilities of `volumes` random choices, some clusters left out.
std::vector<float> random_choices(std::uint32_t volumes, std::uint32_t clusters) {
    Uniforms random(9);
    std::vector<float> cdf;
    for (std::uint32_t volume = 0; volume < volumes; ++volume) {
        std::vector<float> weights(clusters);
        float total = 0.0f;
        for (float& weight : weights) total += weight = random.below(3) == 0 ? 0.0f : random.next();
        float sum = 0.0f;
        for (std::uint32_t i = 0; i + 1 < clusters; ++i)
            cdf.push_back(std::min((sum += weights[i]) / (total + 1e-3f), 1.0f));
        cdf.push_back(1.0f);
    }
    return cdf;
}

struct TreeComparison {
    int lit = 0;      ///< vertices whose sample can contribute
    int layered = 0;  ///< of them at rough conductors
    int learned = 0;  ///< of them where a choice is learned
};

/// Blocks of vertices of which some are layered, and some have a learned choice of lights.
TreeComparison compare_tree(const SceneView& scene, const ChoosesLights& method, std::uint32_t volumes,
                            const LaneKernels& kernels) {
    const PathSettings settings{.next_event = 1};
    const PathContext<ChoosesLights> context{scene, method, settings};
    const LightTable table(scene);
    const auto block = std::make_unique<VertexBlock<kMany, ChoosesLights>>();
    const auto lights = std::make_unique<LightBlock<kMany, ChoosesLights>>(context, table, kernels);
    DirectionGroup directions[kBlockGroups];
    Uniforms random(6);
    TreeComparison result;
    for (std::uint32_t size = 1; size <= kPathBlock; ++size) {
        block->clear();
        std::vector<UnweightedLight> expected;
        for (std::uint32_t i = 0; i < size; ++i) {
            auto& point = block->next_layered();
            point.surface = random_point(scene, random).surface;
            point.vertex = {};
            if (random.below(3) == 0) point.surface.material = 2;
            point.bsdf = make_bsdf<kMany>(scene, point.surface, Vec3f{1.0f / 3.0f}, point.surface.geometric_normal);
            if (random.below(3) != 0) point.vertex.volume = static_cast<std::int32_t>(random.below(volumes));
            const Vec4f u = random_numbers(random);
            expected.push_back(sample_light(context, point, u, {}));
            block->add(i, point, {}, {.light = u});
        }
        lights->sample(*block);
        lights->weigh(*block, directions);
        for (std::uint32_t i = 0; i < size; ++i) {
            const bool is_lit = expected[i].pdf_sa > 0.0f;
            if (block->is_layered(i)) {
                const UnweightedLight light = lights->sample_layered(*block, i);
                REQUIRE(light.pdf_sa == expected[i].pdf_sa);
                REQUIRE((!is_lit || same_ray(light.ray, expected[i].ray)));
                REQUIRE(light.cluster == expected[i].cluster);
                result.layered += is_lit ? 1 : 0;
            } else {
                REQUIRE(lights->is_wanted(i) == is_lit);
                if (!is_lit) continue;
                REQUIRE(lights->groups()[i / kGroupSize].pdf_sa[i % kGroupSize] == expected[i].pdf_sa);
                REQUIRE(lights->estimate(i, Vec3f{1.0f}).cluster == expected[i].cluster);
                REQUIRE(same_ray(lights->shadow_ray(i, block->primitive(i)), expected[i].ray));
            }
            result.lit += is_lit ? 1 : 0;
            result.learned += is_lit && block->vertex(i).volume != kNoVolume ? 1 : 0;
        }
    }
    return result;
}

}  // namespace

TEST_CASE("Lights of a tree are sampled as by one path alone, at all surfaces") {
    constexpr std::uint32_t kVolumes = 20;
    for (const int count : {60, 3000}) {
        const HostScene scene = room_of_lights(
            count, {},
            {.name = "metal", .kind = SurfaceKind::Conductor, .roughness = 0.5f, .specular = {0.9f, 0.8f, 0.7f}});
        const SceneView view = scene.view();
        REQUIRE_FALSE(view.light_tree.empty());
        const std::vector<float> choices = random_choices(kVolumes, view.light_tree.clusters.count);
        ChoosesLights method;
        method.field.light_cdf = {choices.data(), static_cast<std::uint32_t>(choices.size())};
        method.clusters = view.light_tree.clusters.count;
        for (const LaneKernels& kernels : usable_lane_kernels()) {
            INFO(kernels.isa << ", " << count << " lights");
            const TreeComparison result = compare_tree(view, method, kVolumes, kernels);
            CHECK(result.lit > 200);
            CHECK(result.layered > 30);
            CHECK(result.learned > 100);
        }
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
    const auto lights = std::make_unique<LightBlock<kGlass, DefaultMethod>>(context, table);
    Uniforms random(8);
    int lit = 0;
    int absorbed = 0;
    for (int round = 0; round < 20; ++round) {
        block->clear();
        std::vector<UnweightedLight> expected;
        for (std::uint32_t i = 0; i < kPathBlock; ++i) {
            const SurfacePoint surface = random_point(view, random).surface;
            const ScatterPoint<kGlass, DefaultMethod> point{
                surface, make_bsdf<kGlass>(view, surface, Vec3f{1.0f / 3.0f}, surface.geometric_normal)};
            const Vec4f u = random_numbers(random);
            const std::uint32_t medium = random.below(2) == 0 ? kInk : kNoMedium;
            block->add(i, point, {.medium = medium}, {.light = u});
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
    const auto lights = std::make_unique<LightBlock<kLights, KeepsEstimates>>(context, table);
    Uniforms random(7);
    block->clear();
    block->add(0, random_point(view, random), {}, {.light = random_numbers(random)});
    lights->sample(*block);
    CHECK_FALSE(lights->is_wanted(0));
}
