// The reach of a volume: the radius of the sphere of incident radiance that Parallax assumes. Learned per volume as the
// radiance-weighted mean distance of the surfaces that its paths hit.
#pragma once

#include "core/kernel/guiding/table_update.h"

namespace pl {

/// Distances are in units of the extent, the diagonal of the scene's bounds, and clamped to this; so are rays that miss.
inline constexpr float kMostDistance = 1.0f;
/// Radius per mean distance: too small a sphere distorts directions more than too large a one. Measured from 1 to 2,
/// see docs/notebook/2026-11-21-parallax.md.
inline constexpr float kReachPerDistance = 1.5f;
/// Prior of the mean distance, and its weight in training samples.
inline constexpr float kUnknownDistance = 1.0f / 3.0f;
inline constexpr float kUnknownWeight = 16.0f;
inline constexpr float kLeastReach = 0x1p-10f;

inline constexpr float kReachStepsPerUnit = 65536.0f;
inline constexpr float kMaxReachWeight = 16777216.0f;

/// One over the radius; 0, no parallax, if the scene has no finite extent.
PL_HD inline float inverse_reach_of(float extent, float mean_distance) {
    const float inverse = 1.0f / (extent * max_of(kReachPerDistance * mean_distance, kLeastReach));
    return inverse > 0.0f && inverse < kInfinity ? inverse : 0.0f;
}

/// Adds the distance along a direction to the surface it hit, weighted by light_weight().
PL_HD inline void record_reach(const TableView& field, std::int32_t volume, float weight, float distance) {
    if (!(weight > 0.0f) || !(distance > 0.0f) || !(field.extent > 0.0f)) return;
    const auto index = static_cast<std::uint32_t>(volume);
    const float steps = min_of(weight, kMaxReachWeight) * kReachStepsPerUnit;
    atomic_add(field.pending_distance[index],
               static_cast<std::int64_t>(steps * min_of(distance / field.extent, kMostDistance)), field.writers);
    atomic_add(field.pending_light[index], static_cast<std::int64_t>(steps), field.writers);
}

/// Moves a volume's reach to the weighted mean of all training samples so far.
PL_HD inline void move_reach(const TableUpdateView& field, std::uint32_t volume) {
    field.reach_distance[volume] += static_cast<float>(field.pending_distance[volume]) / kReachStepsPerUnit;
    field.reach_weight[volume] += static_cast<float>(field.pending_light[volume]) / kReachStepsPerUnit;
    field.pending_distance[volume] = 0;
    field.pending_light[volume] = 0;
    const float mean = (field.reach_distance[volume] + kUnknownWeight * kUnknownDistance) /
                       (field.reach_weight[volume] + kUnknownWeight);
    field.inverse_reach[volume] = inverse_reach_of(field.extent, mean);
}

}  // namespace pl
