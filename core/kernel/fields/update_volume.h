// All that happens to a volume between two passes.
#pragma once

#include "core/kernel/fields/mixture.h"
#include "core/kernel/fields/reach.h"

namespace pl {

/// Publishes one volume: absorbs the pass's records and rebuilds everything derived from the learned radiance. The
/// steps in their order; a device runs each for all volumes at once.
PL_HD inline void update_volume(const TableUpdateView& field, std::uint32_t volume) {
    const auto cells = static_cast<std::uint32_t>(field.cells.count());
    const auto side = static_cast<std::uint32_t>(field.cells.side);
    for (std::uint32_t cell = volume * cells; cell < (volume + 1) * cells; ++cell) absorb_samples(field, cell);
    update_means(field, volume);
    for (std::uint32_t row = volume * side; row < (volume + 1) * side; ++row) weigh_row(field, row);
    for (std::uint32_t row = volume * side; row < (volume + 1) * side; ++row) build_row(field, row);
    build_row_choice(field, volume);
    move_mixture(field, volume);
    move_reach(field, volume);
}

}  // namespace pl
