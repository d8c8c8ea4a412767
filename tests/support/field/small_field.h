// The smallest learned field, for tests of files that compare every bit.
#pragma once

#include <random>
#include <utility>

#include "core/session/learned_field.h"

namespace pl::test {

inline constexpr int kVolumes = 3;

inline HostVolumes small_volumes() {
    HostVolumes volumes;
    for (int i = 0; i < kVolumes; ++i) {
        const auto x = static_cast<float>(i);
        const Vec3f normal{0.0f, i % 2 == 0 ? 1.0f : -1.0f, 0.0f};
        volumes.sites.push_back({.position = {x, 0.1f * x, -2.0f * x},
                                 .geometric_normal = normal,
                                 .shading_normal = {0.6f, 0.0f, 0.8f},
                                 .position_error = 1.0e-6f * x,
                                 .primitive = static_cast<std::uint32_t>(i),
                                 .material = 5,
                                 .front = i % 2 == 0});
        volumes.normals.push_back(normal);
    }
    volumes.kd_nodes = build_kd_tree(view_of(std::as_const(volumes.sites)));
    return volumes;
}

/// Every member differs from its default, in the middle of a pass; small, because tests compare every bit.
inline LearnedField small_field() {
    LearnedField field{.method = MethodId::Precomputed,
                       .scene_hash = "0123456789abcdef",
                       .settings = {.volumes = kVolumes,
                                    .budget_megabytes = 0.7,
                                    .bins = 4,
                                    .rate = LearningRate::SampleMean,
                                    .uniform_floor = 0.1f,
                                    .precompute_samples = 9,
                                    .refine_share = 0.75f},
                       .shape = {.cells = {2},
                                 .light_clusters = 2,
                                 .radiance_unit = 0.125f,
                                 .extent = 3.0f,
                                 .rate = LearningRate::SampleMean,
                                 .uniform_floor = 0.1f},
                       .volumes = std::make_shared<const HostVolumes>(small_volumes()),
                       .refinement = {.rounds = 2, .added = 1},
                       .field = {},
                       .progress = {.passes = std::uint64_t{3} << 40,
                                    .records = std::uint64_t{5} << 50,
                                    .clamped_records = 13,
                                    .lookup_misses = 7,
                                    .precomputed_slices = 4,
                                    .next_probe = 11}};
    HostTables tables = make_arrays<HostTables>(field.shape, kVolumes);
    std::mt19937 random(1);
    const auto uniform = [&] { return std::uniform_real_distribution<float>(0.0f, 1.0f)(random); };
    for (float& radiance : tables.radiance) radiance = 10.0f * uniform();
    for (float& radiance : tables.mean_radiance) radiance = 10.0f * uniform();
    for (std::uint32_t& visits : tables.visits) visits = static_cast<std::uint32_t>(random());
    for (std::uint32_t& count : tables.pending_count) count = 1 + static_cast<std::uint32_t>(random()) % 9;
    for (std::int64_t& sum : tables.pending_sum) sum = static_cast<std::int64_t>(random()) << 8;
    for (LargeArray<float>* reach : {&tables.reach_weight, &tables.inverse_reach})
        for (float& value : *reach) value = uniform();
    for (std::int64_t& light : tables.pending_light) light = static_cast<std::int64_t>(random());
    for (LargeArray<float>* cdf : {&tables.row_cdf, &tables.column_cdf})
        for (std::size_t i = 0; i < cdf->size(); i += 2) (*cdf)[i] = uniform();
    // The last volume has learned nothing of lights.
    tables.cluster_light = {0.25f, 0.75f, 3.0f, 1.0f, 0.0f, 0.0f};
    tables.light_cdf = {0.25f, 1.0f, 0.75f, 1.0f, 0.0f, 0.0f};
    field.field = std::move(tables);
    return field;
}

}  // namespace pl::test
