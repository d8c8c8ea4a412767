// Heat maps of the learned field: one number per volume, found once per pass. Pixels only look them up.
#pragma once

#include "core/kernel/fields/direction_table.h"
#include "core/kernel/fields/table_update.h"
#include "core/kernel/inspect/views.h"

namespace pl {

/// Records in all cells of a volume.
PL_HD inline float total_visits(const TableUpdateView& field, std::uint32_t volume) {
    const auto cells = static_cast<std::uint32_t>(field.cells.count());
    std::uint64_t total = 0;
    for (std::uint32_t cell = volume * cells; cell < (volume + 1) * cells; ++cell) total += field.visits[cell];
    return static_cast<float>(total);
}

/// Share of a volume's cells that have no record, in [0, 1].
PL_HD inline float unvisited_share(const TableUpdateView& field, std::uint32_t volume) {
    const auto cells = static_cast<std::uint32_t>(field.cells.count());
    float unvisited = 0.0f;
    for (std::uint32_t cell = volume * cells; cell < (volume + 1) * cells; ++cell)
        unvisited += field.visits[cell] == 0 ? 1.0f : 0.0f;
    return unvisited / static_cast<float>(cells);
}

/// Entropy of the cell that a volume's table chooses, in bits: 0 for one certain cell, log2(cells) for a uniform table.
PL_HD inline float table_entropy(const TableUpdateView& field, std::uint32_t volume) {
    const DirectionTable table(field, static_cast<std::int32_t>(volume));
    float bits = 0.0f;
    for (int row = 0; row < field.cells.side; ++row)
        for (int column = 0; column < field.cells.side; ++column) {
            const float p = table.cell_probability(column, row);
            // What is smaller adds less than any sum here resolves.
            if (p >= std::numeric_limits<float>::min()) bits -= p * log2_normal(p);
        }
    return bits;
}

/// Mean change of the cells at the last publication that had records for the volume (the error of temporal
/// differences), relative to the volume's mean radiance; 0 where that is 0.
PL_HD inline float relative_change(const TableUpdateView& field, std::uint32_t volume) {
    const float mean = field.mean_radiance[volume];
    return mean > 0.0f ? min_of(field.change[volume] / mean, std::numeric_limits<float>::max()) : 0.0f;
}

/// What a heat map shows of a volume: not negative, finite. Units as ViewInfo and shown_range() say. Where tables hold
/// what no publication could have put there, 0.
PL_HD inline float volume_value(const TableUpdateView& field, std::uint32_t volume, View view) {
    float value = 0.0f;
    switch (view) {
    case View::Visits: value = total_visits(field, volume); break;
    case View::Irradiance: value = kPi * field.mean_radiance[volume]; break;
    case View::Entropy: value = table_entropy(field, volume); break;
    case View::BsdfShare: value = field.bsdf_fraction[volume]; break;
    case View::Change: value = relative_change(field, volume); break;
    case View::Unvisited: value = unvisited_share(field, volume); break;
    case View::Beauty:
    case View::Direct:
    case View::RadianceMap:
    case View::Voronoi:
    case View::Normal:
    case View::Albedo:
    case View::Depth: break;
    }
    return value > 0.0f && value < kInfinity ? value : 0.0f;
}

}  // namespace pl
