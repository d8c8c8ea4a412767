#include "core/fields/table_model.h"

#include <cmath>

#include <fmt/format.h>

namespace pl {
namespace {

/// Cells that the division left without training samples have no radiance.
void clear_unvisited(HostTables& tables, std::size_t volume, std::size_t cells) {
    for (std::size_t cell = volume * cells; cell < (volume + 1) * cells; ++cell)
        if (tables.visits[cell] == 0) tables.radiance[cell] = 0.0f;
}

}  // namespace

std::string TableModel::text(const FieldShape& shape, const HostTables&) {
    return fmt::format("{} directions", shape.cells.count());
}

HostTables TableModel::split(const FieldShape& shape, HostTables tables, std::span<const std::uint32_t> parents) {
    const std::size_t volumes = volume_count(tables);
    const auto cells = static_cast<std::size_t>(shape.cells.count());
    HostTables refined = split_arrays(shape, std::move(tables), parents);
    for (std::size_t i = 0; i < parents.size(); ++i) {
        clear_unvisited(refined, parents[i], cells);
        clear_unvisited(refined, volumes + i, cells);
    }
    return refined;
}

/// Sums that their counts, or other sums, exclude.
std::optional<FieldDamage> TableModel::damage(const HostTables& tables) {
    constexpr double kMostPerSample = static_cast<double>(kMaxRecordedUnits) * kStepsPerUnit;
    for (std::size_t i = 0; i < tables.pending_sum.size(); ++i) {
        const double most = tables.pending_count[i] * kMostPerSample;
        if (tables.pending_sum[i] < 0 || static_cast<double>(tables.pending_sum[i]) > most)
            return FieldDamage{fmt::format("sum of cell {}", i), fmt::format("0 to {}", most),
                               fmt::format("{}", tables.pending_sum[i])};
    }
    for (std::size_t i = 0; i < tables.pending_light.size(); ++i) {
        const std::int64_t light = tables.pending_light[i];
        if (light < 0 || tables.pending_distance[i] < 0 || tables.pending_distance[i] > light)
            return FieldDamage{fmt::format("distance of volume {}", i), fmt::format("0 to {}", light),
                               fmt::format("{}", tables.pending_distance[i])};
    }
    return std::nullopt;
}

std::size_t table_bytes(int bins, std::size_t light_clusters) {
    const auto side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(bins))));
    return bytes_by_volume<HostTables>(
        {.cells = {side}, .light_clusters = static_cast<std::uint32_t>(light_clusters)});
}

}  // namespace pl
