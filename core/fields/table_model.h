// The table as a representation on the host.
#pragma once

#include "core/fields/representation.h"

namespace pl {

/// Owned arrays in memory of one kind.
template <template <class> class Array>
using TableStorage = TableArrays<Array, Array>;
using HostTables = TableStorage<LargeArray>;

namespace table_arrays {

inline constexpr ArrayOwner kOfCell{
    "cell", [](const FieldShape& shape) { return static_cast<std::size_t>(shape.cells.count()); }};
inline constexpr ArrayOwner kOfRow{
    "row", [](const FieldShape& shape) { return static_cast<std::size_t>(shape.cells.side); }};

inline constexpr auto kUniform = [](const FieldShape& shape, std::size_t i) {
    const auto side = static_cast<std::size_t>(shape.cells.side);
    return static_cast<float>(i % side + 1) / static_cast<float>(side);
};
inline constexpr auto kReach = [](const FieldShape& shape, std::size_t) {
    return inverse_reach_of(shape.extent, kUnknownDistance);
};

using enum OnSplit;
using enum ValidRange;

// clang-format off
inline constexpr auto kAll = SpecList{
    ArraySpec{"radiance", "radiance", kOfCell, Copy, Amount, kZero, [](auto& t) -> auto& { return t.radiance; }},
    ArraySpec{"visits", "visits", kOfCell, Divide, Any, kZero, [](auto& t) -> auto& { return t.visits; }},
    ArraySpec{"sums", "sum", kOfCell, Clear, Any, kZero, [](auto& t) -> auto& { return t.pending_sum; }},
    ArraySpec{"counts", "count", kOfCell, Clear, Any, kZero, [](auto& t) -> auto& { return t.pending_count; }},
    ArraySpec{"row table", "row table", kOfRow, Copy, Cumulative, kUniform, [](auto& t) -> auto& { return t.row_cdf; }},
    ArraySpec{"column table", "column table", kOfCell, Copy, Cumulative, kUniform, [](auto& t) -> auto& { return t.column_cdf; }},
    ArraySpec{"mean radiance", "mean radiance", kOfVolume, Copy, Amount, kZero, [](auto& t) -> auto& { return t.mean_radiance; }},
} + kLightArrays + SpecList{
    ArraySpec{"changes", "change", kOfVolume, Copy, Amount, kZero, [](auto& t) -> auto& { return t.change; }},
} + mixture_arrays(kOfVolume) + SpecList{
    ArraySpec{"sums of distances", "sum of distances", kOfVolume, Clear, Any, kZero, [](auto& t) -> auto& { return t.pending_distance; }},
    ArraySpec{"sums of light", "sum of light", kOfVolume, Clear, Any, kZero, [](auto& t) -> auto& { return t.pending_light; }},
    ArraySpec{"distances of the reach", "distance of the reach", kOfVolume, Halve, Amount, kZero, [](auto& t) -> auto& { return t.reach_distance; }},
    ArraySpec{"weights of the reach", "weight of the reach", kOfVolume, Halve, Amount, kZero, [](auto& t) -> auto& { return t.reach_weight; }},
    ArraySpec{"inverse reaches", "inverse reach", kOfVolume, Copy, Amount, kReach, [](auto& t) -> auto& { return t.inverse_reach; }},
};
// clang-format on

}  // namespace table_arrays

struct TableInspector {
    TableField field;

    float radiance(std::uint32_t volume, int cell) const { return field.radiance[index_of(volume, cell)]; }
    float probability(std::uint32_t volume, int cell) const {
        const DirectionTable table(field, static_cast<std::int32_t>(volume));
        return table.cell_probability(cell % field.cells.side, cell / field.cells.side);
    }
    std::uint32_t samples(std::uint32_t volume, int cell) const { return field.visits[index_of(volume, cell)]; }
    float density(std::uint32_t volume, Vec2f square) const {
        return square_density<One>(DirectionTable(field, static_cast<std::int32_t>(volume)), unpack(square));
    }
    float bsdf_fraction(std::uint32_t volume) const { return field.bsdf_fraction[volume]; }

private:
    std::uint32_t index_of(std::uint32_t volume, int cell) const {
        return field.cell_index(static_cast<std::int32_t>(volume), cell);
    }
};

/// The arrays for the update and for heat maps, in memory of any kind.
template <template <class> class Array>
TableUpdateView update_view(const FieldShape& shape, TableStorage<Array>& tables) {
    TableUpdateView view;
    view.cells = shape.cells;
    view.light_clusters = shape.light_clusters;
    view.radiance_unit = shape.radiance_unit;
    view.extent = shape.extent;
    view.rate = shape.rate;
    view.uniform_floor = shape.uniform_floor;
    set_arrays(table_arrays::kAll, view, tables);
    return view;
}

struct TableModel {
    using Field = TableField;
    template <template <class> class Array>
    using Storage = TableStorage<Array>;

    static constexpr ChoiceInfo<Representation> kInfo{.value = Representation::Table,
                                                      .name = "table",
                                                      .label = "Table",
                                                      .sentence = "cells of directions in each radiance volume"};
    static constexpr double kGuidance = 1.0;
    static constexpr const auto& kArrays = table_arrays::kAll;

    template <template <class> class Array, template <class> class TableArray>
    static TableField view(const FieldShape& shape, const VolumeStorage<Array>& volumes,
                           TableStorage<TableArray>& tables) {
        TableField field;
        set_common(shape, placement_view(volumes, shape.extent), field);
        set_arrays(kArrays, field, tables);
        return field;
    }
    template <template <class> class Array>
    static TableVolumeSummary summary(const FieldShape& shape, const HostVolumes&, TableStorage<Array>& tables) {
        return {update_view(shape, tables)};
    }
    static TableInspector inspector(const TableField& field) { return {field}; }
    static std::string text(const FieldShape& shape, const HostTables&);

    /// A cell left without training samples has no radiance.
    static HostTables split(const FieldShape& shape, HostTables tables, std::span<const std::uint32_t> parents);
    static std::optional<FieldDamage> damage(const HostTables& tables);
};
template <template <class> class Array>
TableModel model_of(const TableStorage<Array>&);
static_assert(FieldModel<TableModel>);

/// Bytes of the table of one volume. `light_clusters`: of the scene's light tree.
std::size_t table_bytes(int bins, std::size_t light_clusters = 0);

}  // namespace pl
