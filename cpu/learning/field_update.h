// The update of a field on the CPU: of tables update_volume() in SIMD lanes where they fit, and only of volumes that it would change.
#pragma once

#include "core/fields/field_model.h"
#include "core/kernel/guiding/update_volume.h"
#include "cpu/base/lane_kernels.h"
#include "cpu/base/parallel_for.h"

namespace pl {

/// Whether paths have added to any of a volume's pending sums. A volume without them keeps every bit in update_volume(),
/// once it has been updated: all that it derives depends on the learned sums alone. A pending sum of radiance without a count
/// waits for its training sample.
inline bool has_new_samples(const LaneKernels& kernels, const TableUpdateView& field, std::uint32_t volume) {
    return (field.pending_slope[volume] | field.pending_curvature[volume] | field.pending_distance[volume] |
            field.pending_light[volume]) != 0 ||
           field.pending_direct_count[volume] != 0 || kernels.has_samples(field, volume);
}

/// update_volume(), to the bit.
inline void update_volume_in_lanes(const LaneKernels& kernels, const TableUpdateView& field, std::uint32_t volume) {
    if (!kernels.update_table(field, volume)) {
        update_volume(field, volume);
        return;
    }
    absorb_light_samples(field, volume);
    move_mixture(field, volume);
    move_reach(field, volume);
}

/// Calls fn(volume) for every volume, in chunks on several threads.
template <class Fn>
void for_each_volume(std::size_t volumes, int threads, Fn&& fn) {
    constexpr std::uint32_t kVolumeChunk = 16;
    ChunkQueue queue(0, static_cast<std::uint32_t>(volumes), kVolumeChunk);
    parallel_for(threads, queue, [&](IndexRange range) {
        for (std::uint32_t volume = range.begin; volume < range.end; ++volume) fn(volume);
    });
}

/// Absorbs the pending sums of a field of any representation. `is_updated`: all its volumes have been updated since the arrays were made,
/// split or loaded.
void update_field(const FieldShape& shape, const HostVolumes& volumes, HostField& field, bool is_updated,
                  int threads);

}  // namespace pl
