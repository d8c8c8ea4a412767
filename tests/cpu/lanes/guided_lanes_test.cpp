// Guided directions sampled in SIMD lanes have the bits of the scalar code.

#include "cpu/paths/direction_block.h"
#include "tests/cpu/put_vertex.h"
#include "tests/support/catch.hpp"
#include "tests/support/field/field_fixture.h"
#include "tests/support/field/guided_methods.h"
#include "tests/support/same_bits.h"

using namespace pl;
using namespace pl::test;

namespace {

/// Unit normals over the whole sphere, including the axes.
std::vector<Vec3f> all_around(int count, Uniforms& random) {
    std::vector<Vec3f> normals{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}};
    while (static_cast<int>(normals.size()) < count) normals.push_back(random.direction());
    return normals;
}

/// Mostly uniform, sometimes the ends of [0, 1) and 1/2, at which mappings and tents switch branches.
float any_number(Uniforms& random) {
    constexpr float kSpecial[] = {0.0f, 0.5f, 0.25f, 0.75f, 1.0f - 0x1p-24f, 0x1p-24f};
    return random.below(8) == 0 ? kSpecial[random.below(6)] : random.next();
}

/// Fills the groups once and compares their directions with the directions of the scalar code.
void check_round(const LaneKernels& kernels, const PrecomputedMethod& method, const std::vector<Vec3f>& normals,
                 Uniforms& random) {
    constexpr std::uint32_t kGroups = 3;
    VertexGroup vertices[kGroups];
    GuidedGroup groups[kGroups];
    SampledGroup sampled[kGroups];
    DirectionGroup directions[kGroups];
    for (std::uint32_t i = 0; i < kGroups * kGroupSize; ++i) {
        GuidedGroup& group = groups[i / kGroupSize];
        VertexGroup& at = vertices[i / kGroupSize];
        const std::uint32_t lane = i % kGroupSize;
        const auto volumes = static_cast<std::uint32_t>(normals.size());
        const auto volume = static_cast<std::int32_t>(random.below(volumes + 1)) - 1;
        const Vec3f normal = normals[random.below(volumes)];
        const Vec3f position = random.between(0.0f, 2.0f) * random.direction();
        if (volume >= 0)
            group.set_volume(lane, method.field.served_point({volume}, SurfacePoint{}),
                             method.bsdf_fraction({volume}));
        at.position.set(lane, position);
        at.shading_normal.set(lane, normal);
        const float choice = any_number(random);
        const float u = any_number(random);
        at.scatter.set(lane, {choice, u, any_number(random)});
    }
    for (std::uint32_t i = 0; i < kGroups; ++i)
        kernels.sample_rows(method.field.sampler(), vertices[i], groups[i], sampled[i]);
    kernels.sample_guided(method.field.sampler(), vertices, groups, sampled, directions, kGroups);
    for (std::uint32_t i = 0; i < kGroups * kGroupSize; ++i) {
        const VertexGroup& at = vertices[i / kGroupSize];
        const std::uint32_t lane = i % kGroupSize;
        SurfacePoint surface;
        surface.position = at.position.get(lane);
        surface.shading_normal = at.shading_normal.get(lane);
        const DirectionSample alone = method.sample_direction({groups[i / kGroupSize].volume[lane]}, surface,
                                                              {.rng = {}, .u = {at.scatter.get(lane), 0.0f}});
        REQUIRE(same_bits(directions[i / kGroupSize].get(lane), alone));
    }
}

}  // namespace

TEST_CASE("Every instruction set chooses the guided directions of one path alone, bit by bit") {
    Uniforms random(21);
    const std::vector<Vec3f> normals = all_around(7, random);
    for (const int side : {1, 2, 5, 8, 12, 16, 19, 32}) {
        TestField field(side, normals);
        for (std::size_t volume = 0; volume < normals.size(); ++volume) {
            const auto hard = hard_weights(side);
            field.set_weights(hard[volume % hard.size()].weights, volume);
            field.tables.bsdf_fraction[volume] = 0.1f + 0.8f * random.next();
            field.tables.inverse_reach[volume] = random.below(4) == 0 ? 0.0f : random.between(0.1f, 3.0f);
        }
        for (const bool learned : {false, true}) {
            PrecomputedMethod method;
            method.field = field.view();
            method.mixture = {.learned = learned ? 1u : 0u, .bsdf_fraction = 0.3f};
            for (const LaneKernels& kernels : usable_lane_kernels()) {
                INFO(kernels.isa << ", side " << side);
                for (int round = 0; round < 50; ++round) check_round(kernels, method, normals, random);
            }
        }
    }
}

TEST_CASE("Without volumes a block of paths scatters by the BSDF") {
    PrecomputedMethod method;
    VertexBlock<FeatureSet{}, PrecomputedMethod> block;
    DirectionBlock<FeatureSet{}, PrecomputedMethod> directions(method);
    const ScatterPoint<FeatureSet{}, PrecomputedMethod> point{.surface = SurfacePoint{}, .bsdf = {Vec3f{0.5f}}};
    block.clear(8);
    put_vertex(block, 7, point, {.scatter = {0.25f, 0.75f, 0.125f, 0.0f}});
    block.set_reached(1u << 7);
    block.set_continuing(1u << 7);
    directions.clear();
    directions.add(7, point.surface, point.vertex, {});
    directions.complete(block);
    directions.sample(block);
    const DirectionSample direction = directions.groups()[0].get(7);
    CHECK(direction.wi == lambert_sample(SurfacePoint{}, {0.75f, 0.125f}));
    CHECK(direction.pdf_sa == direction.bsdf_pdf_sa);
    CHECK(direction.bin == -1);
}
