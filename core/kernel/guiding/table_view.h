// A field of tables as kernels read it while paths are traced: constant sampling tables, and the pending sums that
// training samples are added to. core/fields owns the memory.
#pragma once

#include "core/kernel/base/atomics.h"
#include "core/kernel/guiding/direction_cells.h"
#include "core/kernel/guiding/placement_view.h"
#include "core/kernel/guiding/table_arrays.h"
#include "core/kernel/guiding/volume_record.h"

namespace pl {

/// Targets are clamped at this multiple of the field's radiance unit before they are summed. Pictures are not.
inline constexpr float kMaxRecordedUnits = 65536.0f;

/// Steps per radiance unit of the fixed-point sums: 2^-24 resolves a float's mantissa, and 63 bits hold 2^23 - 1 samples of
/// the largest target between two updates.
inline constexpr float kStepsPerUnit = 16777216.0f;

/// A Span that only reads; a type of its own, because nvcc takes an alias template for the template that it names.
template <class T>
struct ConstSpan : Span<const T> {
    using Span<const T>::Span;
};

struct TableView : PlacementView, TableArrays<ConstSpan, Span> {
    DirectionCells cells;
    std::uint32_t light_clusters = 0;  ///< of the scene's light tree; 0: no tree
    float radiance_unit = 1.0f;        ///< of the fixed-point sums: a power of two not below the brightest emission
    Writers writers = Writers::Many;   ///< threads that add to the pending sums
    Span<const VolumeRecord> records;  ///< read instead of the arrays they repeat; empty: none are gathered. [volume]

    /// A device always has records.
    PL_HD bool has_records() const { return is_device_code() || !records.empty(); }
    PL_HD VolumeRecord record_of(std::uint32_t volume) const { return records[volume]; }
    PL_HD float mean_radiance_of(std::uint32_t volume) const {
        return has_records() ? record_of(volume).mean_radiance : mean_radiance[volume];
    }

    PL_HD std::uint32_t cell_index(std::int32_t volume, int cell) const {
        return static_cast<std::uint32_t>(volume) * static_cast<std::uint32_t>(cells.count()) +
               static_cast<std::uint32_t>(cell);
    }
};

PL_HD inline VolumeRecord gather_record(const TableView& field, std::uint32_t volume) {
    return {.position = field.sites[volume].position,
            .inverse_reach = field.inverse_reach[volume],
            .normal = field.normals[volume],
            .bsdf_fraction = field.bsdf_fraction[volume],
            .mean_radiance = field.mean_radiance[volume],
            .direct = field.direct[volume]};
}

/// Whether the sums will hold less than the target.
PL_HD inline bool is_clamped(float target, float radiance_unit) { return target > kMaxRecordedUnits * radiance_unit; }

/// Fixed-point steps of a target; 0 for NaN and negative values.
PL_HD inline std::int64_t to_fixed_point(float target, float radiance_unit) {
    const float units = target / radiance_unit;
    if (!(units > 0.0f)) return 0;
    return static_cast<std::int64_t>(min_of(units, kMaxRecordedUnits) * kStepsPerUnit);
}

/// Mean target of `count` training samples, whose sum in fixed-point steps is rounded to `steps`.
template <class N>
PL_INLINE typename N::Real mean_of_steps(const typename N::Real& steps, const typename N::Uint& count,
                                         float radiance_unit) {
    return (steps / kStepsPerUnit) / N::count_to_real(count) * radiance_unit;
}
PL_HD inline float from_fixed_point(std::int64_t sum, std::uint32_t count, float radiance_unit) {
    return mean_of_steps<One>(static_cast<float>(sum), count, radiance_unit);
}

/// Adds one training sample of the radiance incident at a volume through a cell. Any thread, any order: the same sums.
PL_HD inline void record(const TableView& field, std::int32_t volume, int cell, float target) {
    const std::uint32_t index = field.cell_index(volume, cell);
    atomic_add_counted(field.pending_sum[index], to_fixed_point(target, field.radiance_unit),
                       field.pending_count[index], field.writers);
}

}  // namespace pl
