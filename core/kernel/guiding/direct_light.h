// The irradiance by light samples of a volume: the part of the light that light samples bring, which a field trained for
// scattered directions leaves to them.
#pragma once

#include "core/kernel/guiding/table_update.h"

namespace pl {

/// Moves a volume's irradiance by light samples towards the mean of the new ones, at the rate of the cells: their MIS weights
/// follow the tables.
PL_HD inline void absorb_light_samples(const TableUpdateView& field, std::uint32_t volume) {
    const std::uint32_t fresh = field.pending_direct_count[volume];
    if (fresh == 0) return;
    const float mean = from_fixed_point(field.pending_direct[volume], fresh, field.radiance_unit);
    const float old = field.direct[volume];
    field.direct[volume] = old + learning_step(field.direct_count[volume], fresh, field.rate) * (mean - old);
    field.direct_count[volume] += min_of(fresh, 0xffffffffu - field.direct_count[volume]);
    field.pending_direct[volume] = 0;
    field.pending_direct_count[volume] = 0;
}

}  // namespace pl
