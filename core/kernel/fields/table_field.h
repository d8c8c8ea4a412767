// The learned field as the kernels see it: volumes, their sampling tables (frozen while paths are under way) and the sums
// in which they collect what they saw. core/fields owns the memory.
#pragma once

#include "core/kernel/base/atomics.h"
#include "core/kernel/base/frame.h"
#include "core/kernel/fields/direction_cells.h"
#include "core/kernel/fields/volume_grid.h"

namespace pl {

/// Learned radiance is clamped at this multiple of the field's radiance unit before it is summed. Pictures are not.
inline constexpr float kMaxRecordedUnits = 65536.0f;

/// Steps per radiance unit of the fixed-point sums: 2^-24 resolves what a float can, 63 bits hold 2^23 - 1 records of
/// the largest value in one pass and cell.
inline constexpr float kStepsPerUnit = 16777216.0f;

struct TableField {
    DirectionCells cells;
    KdTreeView tree;
    VolumeGridView grid;
    Span<const Vec3f> normals;       ///< [volume], unit: the hemisphere that the cells divide
    Span<const SurfacePoint> sites;  ///< [volume], where it stands

    /// Sampling tables: inclusive cumulative probabilities, each ending in exactly 1.
    Span<const float> row_cdf;     ///< [volume][row]
    Span<const float> column_cdf;  ///< [volume][row][column], within the row
    /// Cosine-weighted mean of the learned incident radiance (luminance): irradiance / pi. [volume]
    Span<const float> mean_radiance;

    Span<const float> bsdf_fraction;  ///< learned share of the BSDF in the mixture. [volume]
    Span<const float> inverse_reach;  ///< one over the radius of Parallax. [volume]

    /// What the running pass adds. [volume][cell]
    Span<std::int64_t> pending_sum;
    Span<std::uint32_t> pending_count;
    /// The same for the mixture, see record_mixture(). [volume]
    Span<std::int64_t> pending_slope;
    Span<std::int64_t> pending_curvature;
    /// The same for the reach, see record_reach(). [volume]
    Span<std::int64_t> pending_distance;
    Span<std::int64_t> pending_light;

    /// Radiance of one fixed-point unit: a power of two not below the brightest emission.
    float radiance_unit = 1.0f;
    float extent = 0.0f;  ///< unit of distances: the diagonal of the scene's bounds; 0 if unknown

    /// What the tables were made of, for targets that ask for single cells. [volume][cell]
    Span<const float> radiance{};
    Span<const std::uint32_t> visits{};

    Writers writers = Writers::Many;  ///< of the running pass

    /// The volume that serves a surface point, or kNoVolume.
    PL_HD std::int32_t volume_at(const SurfacePoint& point) const { return find(point).volume; }
    PL_HD FoundVolume find(const SurfacePoint& point) const { return find_volume(tree, grid, point); }

    PL_HD std::int32_t volume_count() const { return static_cast<std::int32_t>(normals.count); }

    PL_HD std::uint32_t cell_index(std::int32_t volume, int cell) const {
        return static_cast<std::uint32_t>(volume) * static_cast<std::uint32_t>(cells.count()) +
               static_cast<std::uint32_t>(cell);
    }
    PL_HD Frame frame(std::int32_t volume) const { return make_frame(normals[static_cast<std::uint32_t>(volume)]); }
};

/// Whether the sums will hold less than was observed.
PL_HD inline bool is_clamped(float radiance, float radiance_unit) {
    return radiance > kMaxRecordedUnits * radiance_unit;
}

/// Fixed-point steps of one recorded radiance; NaN and negative values record nothing.
PL_HD inline std::int64_t to_fixed_point(float radiance, float radiance_unit) {
    const float units = radiance / radiance_unit;
    if (!(units > 0.0f)) return 0;
    return static_cast<std::int64_t>(min_of(units, kMaxRecordedUnits) * kStepsPerUnit);
}

/// Mean radiance of `count` records.
PL_HD inline float from_fixed_point(std::int64_t sum, std::uint32_t count, float radiance_unit) {
    return (static_cast<float>(sum) / kStepsPerUnit) / static_cast<float>(count) * radiance_unit;
}

/// Adds one observation of the radiance that arrives at a volume through a cell. Any thread, any order.
PL_HD inline void record(const TableField& field, std::int32_t volume, int cell, float radiance) {
    const std::uint32_t index = field.cell_index(volume, cell);
    atomic_add_counted(field.pending_sum[index], to_fixed_point(radiance, field.radiance_unit),
                       field.pending_count[index], field.writers);
}

}  // namespace pl
