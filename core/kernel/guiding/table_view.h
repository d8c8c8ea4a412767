// A field of tables as kernels read it while paths are traced: constant sampling tables, and the pending sums that
// training samples are added to. core/fields owns the memory.
#pragma once

#include "core/kernel/guiding/field_view.h"
#include "core/kernel/guiding/volume_record.h"

namespace pl {

/// The arrays of a field of tables. Their lengths, initial values and division when a volume is split are in core/fields/table_model.h.
/// Shapes: [volume][cell] with cells row by row, [volume][row], or [volume].
template <template <class> class Learned, template <class> class Pending>
struct TableArrays : MixtureSums<Learned, Pending>, LightSampleSums<Learned, Pending> {
    Learned<float> radiance;               ///< learned incident radiance Q, rms(). [volume][cell]
    Learned<std::uint32_t> visits;         ///< training samples so far. [volume][cell]
    Pending<std::int64_t> pending_sum;     ///< of targets, fixed point. [volume][cell]
    Pending<std::uint32_t> pending_count;  ///< of training samples. [volume][cell]

    /// Inclusive cumulative probabilities, each row ending in exactly 1.
    Learned<float> row_cdf;     ///< [volume][row]
    Learned<float> column_cdf;  ///< within the row. [volume][row][column]

    Learned<float> mean_radiance;  ///< cosine-weighted mean of Q over the hemisphere: irradiance / pi. [volume]
    Learned<float> change;         ///< mean |new - old| of the cells that the last update moved. [volume]

    Pending<std::int64_t> pending_distance;  ///< see record_reach(). [volume]
    Pending<std::int64_t> pending_light;     ///< [volume]
    Learned<float> reach_distance;  ///< sum of weight times distance of the training samples so far. [volume]
    Learned<float> reach_weight;    ///< sum of their weights. [volume]
    Learned<float> inverse_reach;   ///< one over the radius of Parallax. [volume]
};

struct TableView : FieldView, TableArrays<ConstSpan, Span> {
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

/// Adds one training sample of the radiance incident at a volume through a cell. Any thread, any order: the same sums.
PL_HD inline void record(const TableView& field, std::int32_t volume, int cell, float target) {
    const std::uint32_t index = field.cell_index(volume, cell);
    atomic_add_counted(field.pending_sum[index], to_fixed_point(target, field.radiance_unit),
                       field.pending_count[index], field.writers);
}

}  // namespace pl
