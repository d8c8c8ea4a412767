// The update of one volume: its table, irradiance by light samples, BSDF fraction and reach.
#pragma once

#include "core/kernel/guiding/direct_light.h"
#include "core/kernel/guiding/mixture.h"
#include "core/kernel/guiding/reach.h"

namespace pl {

/// Absorbs the pending training samples of one volume and rebuilds everything derived from its learned radiance. A device runs
/// each of the steps, in this order, for all volumes at once.
PL_HD inline void update_volume(const TableUpdateView& field, std::uint32_t volume) {
    const auto cells = static_cast<std::uint32_t>(field.cells.count());
    const auto side = static_cast<std::uint32_t>(field.cells.side);
    for (std::uint32_t cell = volume * cells; cell < (volume + 1) * cells; ++cell) absorb_samples(field, cell);
    update_means(field, volume);
    for (std::uint32_t row = volume * side; row < (volume + 1) * side; ++row) weigh_row(field, row);
    for (std::uint32_t row = volume * side; row < (volume + 1) * side; ++row) build_row(field, row);
    build_row_choice(field, volume);
    absorb_light_samples(field, volume);
    move_mixture(field, volume);
    move_reach(field, volume);
}

}  // namespace pl
