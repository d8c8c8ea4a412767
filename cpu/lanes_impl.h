// The body of the lane kernels. Each lanes_*.cpp compiles it for one instruction set, which CMakeLists.txt gives the file;
// nothing here may be visible outside of that file.
#pragma once

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

constexpr LaneKernels lane_kernels_named(const char* name) {
    return {name, find_closest, find_occluded, draw, choose_rows, sample_guided};
}

}  // namespace
}  // namespace pl
