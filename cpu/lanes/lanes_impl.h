// Implementation of the lane kernels. Each lanes_*.cpp compiles it for one instruction set, whose compiler options
// are set in cpu/CMakeLists.txt. All definitions have internal linkage; see lanes.h.
#pragma once

#include "cpu/lanes/dense_lanes.h"
#include "cpu/lanes/instance_lanes.h"
#include "cpu/lanes/light_lanes.h"
#include "cpu/lanes/light_tree_lanes.h"
#include "cpu/lanes/lookup_lanes.h"
#include "cpu/lanes/neural_lanes.h"
#include "cpu/lanes/path_lanes.h"
#include "cpu/lanes/table_lanes.h"
#include "cpu/lanes/update_lanes.h"
#include "cpu/lanes/vertex_lanes.h"
#include "cpu/lanes/wide_lanes.h"

namespace pl {
namespace {

void find_closest(const DenseView& scene, const RayGroup* rays, HitGroup* hits, std::uint32_t groups) {
    closest_of_groups(scene, rays, hits, groups);
}

void find_occluded(const DenseView& scene, const RayGroup* rays, OcclusionMask* masks, std::uint32_t groups) {
    occlusion_of_groups(scene, rays, masks, groups);
}

void find_closest_wide(const WideView& scene, const RayGroup* rays, HitGroup* hits, std::uint32_t count) {
    closest_in_wide(scene, rays, hits, count);
}

void find_occluded_wide(const WideView& scene, const RayGroup* rays, OcclusionMask* masks, std::uint32_t count) {
    occlusion_in_wide(scene, rays, masks, count);
}

void find_closest_instances(const WideInstances& scene, const RayGroup* rays, HitGroup* hits, std::uint32_t count) {
    closest_instances(scene, rays, hits, count);
}

void find_occluding_instances(const WideInstances& scene, const RayGroup* rays, OcclusionMask* masks,
                              std::uint32_t count) {
    occluding_instances(scene, rays, masks, count);
}

void draw(const DrawKey& key, const CounterGroup* counters, UniformGroup* uniforms, std::uint32_t groups) {
    draw_groups(key, counters, uniforms, groups);
}

void draw_vertices(const DrawKey& key, const CounterGroup* counters, UniformGroup* uniforms, std::uint32_t groups) {
    draw_vertex_groups(key, counters, uniforms, groups);
}

void find_camera_directions(const Camera& camera, const PixelGrid& grid, const CounterGroup* counters,
                            const UniformGroup* uniforms, VectorGroup* directions, std::uint32_t groups) {
    for (std::uint32_t group = 0; group < groups; ++group)
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
            CameraLanes(camera, grid, first).find(counters[group], uniforms[group], directions[group]);
}

void find_points(const PlacementRows& scene, const RayGroup* rays, const HitGroup* hits, PointGroup* points,
                 std::uint32_t groups) {
    for_lookup_lanes(scene, groups, [&](const LookupLanes& lanes, std::uint32_t group) {
        lanes.find_points(rays[group], hits[group], points[group]);
    });
}

void mark_places(const PlacementRows& scene, const HitGroup* hits, PointGroup* points, std::uint32_t groups) {
    for (std::uint32_t group = 0; group < groups; ++group) points[group].wanted = points[group].cells = 0;
    for_lookup_lanes(scene, groups, [&](const LookupLanes& lanes, std::uint32_t group) {
        lanes.mark_places(hits[group], points[group]);
    });
}

void read_cells(const PlacementRows& scene, PointGroup* points, std::uint32_t groups) {
    read_cells_of_groups(scene, points, groups);
}

void find_nearest(const PlacementRows& scene, PointGroup* points, std::uint32_t groups) {
    for_lookup_lanes(scene, groups, [&](const LookupLanes& lanes, std::uint32_t group) {
        if (points[group].cells != 0) lanes.find_nearest(points[group]);
    });
}

void sample_rows(const TableSampler& tables, const VertexGroup& vertices, const GuidedGroup& paths,
                 SampledGroup& sampled) {
    sample_rows_of_group(tables, vertices, paths, sampled);
}

void sample_guided(const TableSampler& tables, const VertexGroup* vertices, const GuidedGroup* paths,
                   SampledGroup* sampled, DirectionGroup* directions, std::uint32_t groups) {
    sample_guided_groups(tables, vertices, paths, sampled, directions, groups);
}

void weigh_guided(const TableSampler& tables, const VertexGroup* vertices, const GuidedGroup* paths,
                  const LightSampleGroup* lights, DirectionGroup* directions, std::uint32_t groups) {
    weigh_guided_groups(tables, vertices, paths, lights, directions, groups);
}

void sample_lambert(const VertexGroup* vertices, DirectionGroup* directions, std::uint32_t groups) {
    for_vertex_lanes(vertices, groups,
                     [&](const VertexLanes& lanes, std::uint32_t group) { lanes.sample_lambert(directions[group]); });
}

void weigh_lambert(const VertexGroup* vertices, const LightSampleGroup* lights, DirectionGroup* directions,
                   std::uint32_t groups) {
    for_vertex_lanes(vertices, groups, [&](const VertexLanes& lanes, std::uint32_t group) {
        lanes.weigh_lambert(lights[group], directions[group]);
    });
}

void choose_by_tree(const LightTreeRows& tree, const VertexGroup* vertices, const LearnedLightsGroup* learned,
                    LightSampleGroup* samples, std::uint32_t groups) {
    choose_by_tree_in_groups(tree, vertices, learned, samples, groups);
}

void find_light_densities(const LightTreeRows& tree, LightHitGroup* hits, std::uint32_t groups) {
    find_densities_of_groups(tree, hits, groups);
}

void sample_lights(const LightRows& lights, const VertexGroup* vertices, LightSampleGroup* samples,
                   std::uint32_t groups) {
    for_light_lanes(lights, vertices, groups,
                    [&](const LightLanes& lanes, std::uint32_t group) { lanes.sample_by_power(samples[group]); });
}

void sample_chosen_lights(const LightRows& lights, const VertexGroup* vertices, LightSampleGroup* samples,
                          std::uint32_t groups) {
    for_light_lanes(lights, vertices, groups,
                    [&](const LightLanes& lanes, std::uint32_t group) { lanes.sample_chosen(samples[group]); });
}

void sample_far_lights(const FarRows& lights, const VertexGroup* vertices, FarSampleGroup* far,
                       LightSampleGroup* samples, std::uint32_t groups) {
    SampledTexelOf<Lanes> texels[kBlockGroups][kGroupSize / kLaneWidth];
    const auto for_lanes = [&](const auto& step) {
        for (std::uint32_t group = 0; group < groups; ++group)
            for (std::uint32_t i = 0; i < kGroupSize / kLaneWidth; ++i)
                step(FarLightLanes(lights, vertices[group], i * kLaneWidth), texels[group][i], group);
    };
    using Texel = SampledTexelOf<Lanes>;
    if (!lights.lights->map.empty()) {
        for_lanes([](const FarLightLanes& lanes, Texel& texel, std::uint32_t) { lanes.choose_row(texel); });
        for_lanes([](const FarLightLanes& lanes, Texel& texel, std::uint32_t) { lanes.find_columns(texel); });
        for_lanes([](const FarLightLanes& lanes, Texel& texel, std::uint32_t) { lanes.choose_column(texel); });
    }
    for_lanes([&](const FarLightLanes& lanes, Texel& texel, std::uint32_t group) {
        lanes.sample(texel, far[group], samples[group]);
    });
}

void weigh_lights(const VertexGroup* vertices, const DirectionGroup* directions, LightSampleGroup* samples,
                  std::uint32_t groups) {
    for_vertex_lanes(vertices, groups, [&](const VertexLanes& lanes, std::uint32_t group) {
        lanes.weigh_light(directions[group], samples[group]);
    });
}

void reach_vertices(const SurfaceRows& scene, std::uint32_t max_depth, const BlockRows& block, SegmentMarks& marks) {
    reach_vertices_of_groups(scene, max_depth, block, marks);
}

void play_roulette(const PathSettings& settings, const BlockRows& block, const float* estimates,
                   BlockBits& continuing) {
    mark_path_lanes(block, continuing, [&](const PathLanes& lanes, std::uint32_t group) {
        const float* of_group = estimates == nullptr ? nullptr : estimates + group * kGroupSize;
        return lanes.play_roulette(settings, block.scatter[group], of_group);
    });
}

void scatter_paths(const BlockRows& block, const DirectionGroup* directions, RayGroup* rays, BlockBits& lit) {
    mark_path_lanes(block, lit, [&](const PathLanes& lanes, std::uint32_t group) {
        return lanes.scatter(directions[group], lit.groups[group], rays[group]);
    });
}

std::uint32_t pack_shadow_rays(const BlockRows& block, const LightSampleGroup* samples, BlockBits& lit,
                               LitGroup* kept, RayGroup* rays, std::uint32_t count) {
    return pack_shadow_rays_of_groups(block.vertices, samples, lit, kept, rays, count, block.groups);
}

void connect_paths(const LitGroup* lights, const BlockBits& lit, PathGroup* paths, std::uint32_t groups) {
    for (std::uint32_t group = 0; group < groups; ++group)
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
            ConnectedLanes(paths[group], first).add(lights[group], lit.groups[group]);
}

BlockBits look_up_volumes(const VolumeRows& field, const LearningRows& rows, BlockBits& unknown) {
    BlockBits served{};
    for_table_lanes(rows, [&](const TableLanes& lanes, std::uint32_t group) {
        const TableLanes::LookedUp found = lanes.look_up(field);
        served.groups[group] = static_cast<std::uint16_t>(served.groups[group] | found.served);
        unknown.groups[group] = static_cast<std::uint16_t>(unknown.groups[group] | found.unknown);
    });
    return served;
}

void estimate_contributions(const LearningRows& rows, const BlockBits& reached, BlockFloats& estimates) {
    for_table_lanes(rows, [&](const TableLanes& lanes, std::uint32_t group) {
        lanes.estimate(reached.groups[group], estimates.of + group * kGroupSize);
    });
}

void complete_samples(const LearningRows& rows, bool is_indirect, float most, const BlockFloats& emitted,
                      BlockFloats& targets, BlockBits& samples, BlockBits& clamped) {
    for_table_lanes(rows, [&](const TableLanes& lanes, std::uint32_t group) {
        const TableLanes::Completed completed =
            lanes.complete(is_indirect, most, emitted.of + group * kGroupSize, targets.of + group * kGroupSize);
        samples.groups[group] = static_cast<std::uint16_t>(samples.groups[group] | completed.samples);
        clamped.groups[group] = static_cast<std::uint16_t>(clamped.groups[group] | completed.clamped);
    });
}

void open_samples(const LearningRows& rows, const DirectionGroup* directions, const BlockBits& scattered) {
    for_table_lanes(rows, [&](const TableLanes& lanes, std::uint32_t group) {
        lanes.open(directions[group], scattered.groups[group]);
    });
}

bool has_samples(const TableUpdateView& field, std::uint32_t volume) { return any_sample_in_lanes(field, volume); }

bool update_table(const TableUpdateView& field, std::uint32_t volume) { return update_table_in_lanes(field, volume); }

constexpr LaneKernels lane_kernels_named(const char* name) {
    return {name,
            find_closest,
            find_occluded,
            find_closest_wide,
            find_occluded_wide,
            find_closest_instances,
            find_occluding_instances,
            draw,
            draw_vertices,
            find_camera_directions,
            find_points,
            mark_places,
            read_cells,
            find_nearest,
            sample_rows,
            sample_guided,
            weigh_guided,
            sample_lambert,
            weigh_lambert,
            sample_lights,
            choose_by_tree,
            find_light_densities,
            sample_chosen_lights,
            sample_far_lights,
            weigh_lights,
            reach_vertices,
            play_roulette,
            scatter_paths,
            pack_shadow_rays,
            connect_paths,
            look_up_volumes,
            estimate_contributions,
            complete_samples,
            open_samples,
            has_samples,
            update_table,
            multiply,
            descend,
            attribute,
            evaluate_in_lanes};
}

}  // namespace
}  // namespace pl
