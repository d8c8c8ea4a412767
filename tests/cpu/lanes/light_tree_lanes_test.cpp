// Vectors of vertices choose the lights of the scalar code by a light tree, bit for bit, by every instruction set.
#include <algorithm>
#include <memory>

#include "core/kernel/methods/default.h"
#include "cpu/paths/light_block.h"
#include "tests/cpu/put_vertex.h"
#include "tests/cpu/room_of_lights.h"
#include "tests/support/catch.hpp"

using namespace pl;
using namespace pl::test;

namespace {

constexpr FeatureSet kMany = kRoomEffects.with(Feature::ManyLights).with(Feature::Rough);

/// Default path tracing with a learned choice of lights, of a volume, or none.
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
    const auto lights = std::make_unique<LightBlock<kMany, ChoosesLights>>(context, &table, kernels);
    DirectionGroup directions[kBlockGroups];
    Uniforms random(6);
    TreeComparison result;
    for (std::uint32_t size = 1; size <= kPathBlock; ++size) {
        block->clear(size);
        block->set_reached(first_bits(size));
        std::vector<UnweightedLight> expected;
        for (std::uint32_t i = 0; i < size; ++i) {
            ScatterPoint<kMany, ChoosesLights> point;
            point.surface = random_point(scene, random).surface;
            if (random.below(3) == 0) point.surface.material = 2;
            point.bsdf = make_bsdf<kMany>(scene, point.surface, Vec3f{1.0f / 3.0f}, point.surface.geometric_normal);
            if (random.below(3) != 0) point.vertex.volume = static_cast<std::int32_t>(random.below(volumes));
            const Vec4f u = random_numbers(random);
            expected.push_back(sample_light(context, point, u, {}));
            put_vertex(*block, i, point, {.light = u});
        }
        lights->sample(*block);
        lights->weigh(*block, directions);
        for (std::uint32_t i = 0; i < size; ++i) {
            const bool is_lit = expected[i].pdf_sa > 0.0f;
            if (block->is_layered(i)) {
                const UnweightedLight light = lights->sample_layered(*block, i, {});
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

constexpr std::uint32_t kTreeVolumes = 20;

/// Densities of random lights for random points, of which most have a learned choice, in more groups than take turns at once.
void compare_densities(const SceneView& scene, const ChoosesLights& method, const LaneKernels& kernels) {
    const LightTable table(scene);
    std::vector<LightHitGroup> hits(2 * kBlockGroups + 1);
    std::vector<float> expected;
    Uniforms random(8);
    for (std::uint32_t i = 0; i < hits.size() * kGroupSize; ++i) {
        const Light& light = scene.lights[random.below(scene.lights.count)];
        const SurfacePoint on_light =
            make_surface_point<kMany>(scene, light.primitive, Vec3f{1.0f / 3.0f}, Vec3f{0.0f, 1.0f, 0.0f});
        const Vec3f from = random_point(scene, random).surface.position;
        ChoosesLights::Vertex vertex;
        if (random.below(3) != 0) vertex.volume = static_cast<std::int32_t>(random.below(kTreeVolumes));
        const LearnedLights learned = method.learned_lights(vertex);
        LightHitGroup& group = hits[i / kGroupSize];
        group.from.set(i % kGroupSize, from);
        group.light[i % kGroupSize] = table.light_of(light.primitive);
        CHECK(table.is_light(light.primitive));
        group.learned.set(i % kGroupSize, learned, method.field.light_cdf.data);
        expected.push_back(light_pdf_area<kMany>(scene, from, on_light, learned));
    }
    kernels.find_light_densities(rows_of(scene.light_tree, method.field.light_cdf.data), hits.data(),
                                 static_cast<std::uint32_t>(hits.size()));
    int positive = 0;
    for (std::uint32_t i = 0; i < expected.size(); ++i) {
        REQUIRE(hits[i / kGroupSize].pdf_area[i % kGroupSize] == expected[i]);
        positive += expected[i] > 0.0f ? 1 : 0;
    }
    CHECK(positive > static_cast<int>(expected.size()) / 2);
}

}  // namespace

TEST_CASE("Lights of a tree are sampled, and weighed where they are hit, as by one path alone") {
    for (const int count : {60, 3000}) {
        const HostScene scene = room_of_lights(
            count, {},
            {.name = "metal", .kind = SurfaceKind::Conductor, .roughness = 0.5f, .specular = {0.9f, 0.8f, 0.7f}});
        const SceneView view = scene.view();
        REQUIRE_FALSE(view.light_tree.empty());
        const std::vector<float> choices = random_choices(kTreeVolumes, view.light_tree.clusters.count);
        ChoosesLights method;
        method.field.light_cdf = {choices.data(), static_cast<std::uint32_t>(choices.size())};
        method.clusters = view.light_tree.clusters.count;
        for (const LaneKernels& kernels : usable_lane_kernels()) {
            INFO(kernels.isa << ", " << count << " lights");
            const TreeComparison result = compare_tree(view, method, kTreeVolumes, kernels);
            CHECK(result.lit > 200);
            CHECK(result.layered > 30);
            CHECK(result.learned > 100);
            compare_densities(view, method, kernels);
        }
    }
}
