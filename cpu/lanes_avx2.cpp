#include "cpu/dense_lanes.h"
#include "cpu/guided_lanes.h"

namespace pl {
namespace {

void find_closest(const DenseView& scene, const RayGroup* rays, HitGroup* hits, std::uint32_t groups) {
    closest_of_groups(scene, rays, hits, groups);
}

void find_occluded(const DenseView& scene, const RayGroup* rays, OcclusionMask* masks, std::uint32_t groups) {
    occlusion_of_groups(scene, rays, masks, groups);
}

void draw(const DrawKey& key, const CounterGroup* counters, NumberGroup* numbers, std::uint32_t groups) {
    draw_groups(key, counters, numbers, groups);
}

void choose_rows(const GuidedMixture& mixture, const GuidedGroup& paths, ChosenGroup& chosen) {
    choose_rows_of_group(mixture, paths, chosen);
}

void sample_guided(const GuidedMixture& mixture, const DrawKey& jitter_key, const GuidedGroup* paths,
                   ChosenGroup* chosen, DirectionGroup* directions, std::uint32_t groups) {
    sample_guided_groups(mixture, jitter_key, paths, chosen, directions, groups);
}

}  // namespace

const LaneKernels kLaneKernelsAvx2{"avx2", find_closest, find_occluded, draw, choose_rows, sample_guided};

}  // namespace pl
