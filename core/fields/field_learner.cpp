#include "core/fields/field_learner.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/kernel/guiding/update_volume.h"

namespace pl {
namespace {

bool is_usable(float value) { return value >= 0.0f && value < kInfinity; }

/// As update_volume() goes on from the weights of cells.
void build_probabilities(const TableUpdateView& field, std::uint32_t volume) {
    const auto side = static_cast<std::uint32_t>(field.cells.side);
    for (std::uint32_t row = volume * side; row < (volume + 1) * side; ++row)
        field.row_cdf[row] = pl::sum_of(field.column_cdf.data + row * side, field.cells.side);
    for (std::uint32_t row = volume * side; row < (volume + 1) * side; ++row) build_row(field, row);
    build_row_choice(field, volume);
}

}  // namespace

void require_cells(const FieldShape& shape, std::size_t volumes, const LearnedCells& cells) {
    const char* const what = cells.are_radiance ? "radiance" : "probabilities";
    const auto count = static_cast<std::size_t>(shape.cells.count());
    if (cells.values.size() != volumes * count)
        throw Error(ErrorKind::Input, fmt::format("learner, {}: expected {} volumes of {} cells, {} numbers, got {}",
                                                  what, volumes, count, volumes * count, cells.values.size()));
    const auto fault = std::ranges::find_if_not(cells.values, is_usable);
    if (fault == cells.values.end()) return;
    const auto index = static_cast<std::size_t>(fault - cells.values.begin());
    throw Error(ErrorKind::Input,
                fmt::format("learner, {} of volume {}, cell {}: expected a finite number of at least "
                            "0, got {}",
                            what, index / count, index % count, *fault));
}

void take_cells(const FieldShape& shape, HostTables& tables, const LearnedCells& cells) {
    const TableUpdateView field = update_view(shape, tables);
    const auto volumes = static_cast<std::uint32_t>(volume_count(tables));
    std::ranges::copy(cells.values, cells.are_radiance ? tables.radiance.begin() : tables.column_cdf.begin());
    for (std::uint32_t volume = 0; volume < volumes; ++volume) {
        if (cells.are_radiance)
            update_volume(field, volume);
        else
            build_probabilities(field, volume);
    }
}

}  // namespace pl
