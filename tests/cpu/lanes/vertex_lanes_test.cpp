// Paths that are scattered in SIMD lanes go where paths of the scalar code go, bit for bit, by every instruction set.

#include "core/kernel/methods/default.h"
#include "cpu/base/lane_kernels.h"
#include "tests/cpu/lanes/leaning_point.h"
#include "tests/cpu/put_vertex.h"
#include "tests/support/catch.hpp"
#include "tests/support/same_bits.h"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

namespace {

using LeaningBlock = VertexBlock<FeatureSet{}, DefaultMethod>;

struct Scattering {
    int different = 0;
    int black = 0;
};

Scattering compare_vertices(const LaneKernels& kernels) {
    const DefaultMethod method;
    LeaningBlock block;
    DirectionGroup directions[kBlockGroups];
    PathGroup paths[kBlockGroups];
    RayGroup rays[kBlockGroups];
    Uniforms random(11);
    Scattering result;
    for (int round = 0; round < 40; ++round) {
        block.clear(kPathBlock);
        std::vector<LeaningPoint> points;
        std::vector<Vec4f> numbers;
        for (std::uint32_t i = 0; i < kPathBlock; ++i) {
            points.push_back(random_point(random));
            numbers.push_back({random.cube(0.0f, 1.0f), 0.0f});
            put_vertex(block, i, points.back(), {.scatter = numbers.back()});
            paths[i / kGroupSize].throughput.set(i % kGroupSize, Vec3f{1.0f});
        }
        kernels.sample_lambert(block.groups(), directions, block.group_count());
        BlockBits lit;
        lit.set(first_bits(kPathBlock));
        kernels.scatter_paths({.hits = nullptr,
                               .points = nullptr,
                               .scatter = nullptr,
                               .light = nullptr,
                               .counters = nullptr,
                               .paths = paths,
                               .vertices = block.groups(),
                               .groups = block.group_count()},
                              directions, rays, lit);
        for (std::uint32_t i = 0; i < kPathBlock; ++i) {
            const std::uint32_t lane = i % kGroupSize;
            const PathGroup& to = paths[i / kGroupSize];
            PathState<FeatureSet{}, DefaultMethod> state;
            PathCounters counters;
            DefaultMethod::Sample none;
            const DirectionSample alone =
                method.sample_direction({}, points[i].surface, {.rng = {}, .u = numbers[i]});
            const PathStatus status =
                scatter_lambert(method, points[i], alone, state, StepOutput<DefaultMethod>{none, counters});
            bool same = same_bits(directions[i / kGroupSize].get(lane), alone) &&
                        ((lit.bits() >> i & 1u) != 0) == (status == PathStatus::Continues);
            if (status == PathStatus::Continues)
                same = same && same_bits(to.weight.get(lane), state.throughput) &&
                       same_bits(to.throughput.get(lane), state.throughput) &&
                       same_bits(rays[i / kGroupSize].get(lane).origin, state.ray.origin);
            result.different += same ? 0 : 1;
            result.black += status == PathStatus::Continues ? 0 : 1;
        }
    }
    return result;
}

}  // namespace

TEST_CASE("Every instruction set scatters paths as the scalar code does, bit for bit") {
    for (const LaneKernels& kernels : usable_lane_kernels()) {
        INFO(kernels.isa);
        const Scattering result = compare_vertices(kernels);
        CHECK(result.different == 0);
        CHECK(result.black > 300);
    }
}
