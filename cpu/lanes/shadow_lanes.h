// Shadow rays of a block, packed into a batch. Included by one file per instruction set; see lanes.h.
#pragma once

#include "cpu/lanes/group_rows.h"

namespace pl {
namespace {

#if defined(__AVX512F__)
/// Appends the lanes of a vector that are in `lanes` to a row that is full up to lane `begin`; `next`: the row of the next group.
struct RowPacking {
    std::uint16_t lanes;
    std::uint32_t begin;
    bool reaches_next;

    PL_INLINE void append(const void* row, void* here, void* next) const {
        LaneInt order;
        for (std::uint32_t lane = 0; lane < kLaneWidth; ++lane) order[lane] = static_cast<std::int32_t>(lane);
        order = (order - static_cast<std::int32_t>(begin)) & static_cast<std::int32_t>(kLaneWidth - 1);
        const auto values = std::bit_cast<__m512i>(load_lanes<LaneInt>(static_cast<const std::int32_t*>(row)));
        const __m512i packed = _mm512_maskz_compress_epi32(lanes, values);
        const __m512i turned = _mm512_maskz_permutexvar_epi32(0xffff, std::bit_cast<__m512i>(order), packed);
        _mm512_mask_storeu_epi32(here, static_cast<__mmask16>(0xffffu << begin), turned);
        if (reaches_next) _mm512_storeu_si512(next, turned);
    }
};
#endif

/// Appends the shadow rays of `lanes` to a batch of `count` rays.
PL_INLINE void append_shadow_rays(const LightSampleGroup& samples, const std::uint32_t* sources, std::uint32_t lanes,
                                  RayGroup* rays, std::uint32_t count) {
#if defined(__AVX512F__)
    const std::uint32_t begin = count % kGroupSize;
    const bool reaches_next = begin + static_cast<std::uint32_t>(std::popcount(lanes)) > kGroupSize;
    const RowPacking packing{static_cast<std::uint16_t>(lanes), begin, reaches_next};
    RayGroup& here = rays[count / kGroupSize];
    RayGroup& next = rays[count / kGroupSize + (reaches_next ? 1 : 0)];
    packing.append(samples.origin.x, here.origin_x, next.origin_x);
    packing.append(samples.origin.y, here.origin_y, next.origin_y);
    packing.append(samples.origin.z, here.origin_z, next.origin_z);
    packing.append(samples.direction.x, here.direction_x, next.direction_x);
    packing.append(samples.direction.y, here.direction_y, next.direction_y);
    packing.append(samples.direction.z, here.direction_z, next.direction_z);
    packing.append(sources, here.source, next.source);
    packing.append(samples.target, here.target, next.target);
#else
    for (; lanes != 0; lanes &= lanes - 1, ++count) {
        const auto from = static_cast<std::uint32_t>(std::countr_zero(lanes));
        const std::uint32_t to = count % kGroupSize;
        RayGroup& group = rays[count / kGroupSize];
        group.origin_x[to] = samples.origin.x[from];
        group.origin_y[to] = samples.origin.y[from];
        group.origin_z[to] = samples.origin.z[from];
        group.direction_x[to] = samples.direction.x[from];
        group.direction_y[to] = samples.direction.y[from];
        group.direction_z[to] = samples.direction.z[from];
        group.source[to] = sources[from];
        group.target[to] = samples.target[from];
    }
#endif
}

/// Packs the shadow rays of a block's samples that can contribute, of the paths in `lit`, and keeps their contributions with the paths.
/// Leaves in `lit` the paths that have one. `count`: of the rays in the batch, whose t_max is 1. Returns their number afterwards.
PL_INLINE std::uint32_t pack_shadow_rays_of_groups(const VertexGroup* vertices, const LightSampleGroup* samples,
                                                   BlockBits& lit, LitGroup* kept, RayGroup* rays,
                                                   std::uint32_t count, std::uint32_t groups) {
    for (std::uint32_t group = 0; group < groups; ++group) {
        std::uint32_t lanes = 0;
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
            lanes |= mask_bits(load_lanes<LaneFloat>(samples[group].pdf_sa + first) > 0.0f) << first;
        lanes &= lit.groups[group];
        lit.groups[group] = static_cast<std::uint16_t>(lanes);
        std::memcpy(&kept[group].contribution, &samples[group].contribution, sizeof kept[group].contribution);
        append_shadow_rays(samples[group], vertices[group].primitive, lanes, rays, count);
        count += static_cast<std::uint32_t>(std::popcount(lanes));
    }
    return count;
}

}  // namespace
}  // namespace pl
