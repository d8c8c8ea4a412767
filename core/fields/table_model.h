// The table as a model of a guiding field on the host: the one description of its arrays, and all code derived from
// it.
#pragma once

#include <span>
#include <string_view>

#include "core/base/large_array.h"
#include "core/fields/field_shape.h"
#include "core/fields/placement_storage.h"
#include "core/kernel/guiding/table_field.h"
#include "core/kernel/inspect/heat_map.h"

namespace pl {

/// Owned arrays in memory of one kind.
template <template <class> class Array>
using TableStorage = TableArrays<Array, Array>;
using HostTables = TableStorage<LargeArray>;

/// Number of values of an array.
enum class ArrayExtent { Cell, Row, Volume, LightCluster };

/// Values of the new volume when one is split in two.
enum class OnSplit {
    Copy,    ///< those of its parent
    Halve,   ///< both get half of the parent's
    Divide,  ///< counts: each of the two gets half, odd ones alternate by cell
    Clear,   ///< 0; the parent keeps its values
};

/// Values that files may hold.
enum class ValidRange {
    Any,           ///< all, or checked together with other arrays
    Amount,        ///< finite, at least 0
    Finite,        ///< finite
    NotNegative,   ///< at least 0
    BsdfFraction,  ///< kMinBsdfFraction to kMaxBsdfFraction
    Cumulative,    ///< each row rises from at least 0 to exactly 1
    Choice,        ///< likewise, or all 0
};

/// Description of one array of TableArrays.
template <class Initial, class Get>
struct ArraySpec {
    const char* name;    ///< plural, in messages
    const char* single;  ///< of one value, in messages
    ArrayExtent extent;
    OnSplit on_split;
    ValidRange valid;
    Initial initial;  ///< value i of a field of this shape without training samples: initial(shape, i)
    Get get;          ///< the array of any TableArrays
};
template <class Initial, class Get>
ArraySpec(const char*, const char*, ArrayExtent, OnSplit, ValidRange, Initial, Get) -> ArraySpec<Initial, Get>;

/// Descriptions of the arrays of a model, each of a type of its own. A std::tuple of so many takes seconds to compile.
template <class... Specs>
struct SpecList : Specs... {};
template <class... Specs>
SpecList(Specs...) -> SpecList<Specs...>;

template <class... Specs, class Fn>
constexpr void for_each_spec(const SpecList<Specs...>& all, Fn&& fn) {
    (fn(static_cast<const Specs&>(all)), ...);
}

namespace table_arrays {

inline constexpr auto kZero = [](const FieldShape&, std::size_t) { return 0; };
inline constexpr auto kUniform = [](const FieldShape& shape, std::size_t i) {
    const auto side = static_cast<std::size_t>(shape.cells.side);
    return static_cast<float>(i % side + 1) / static_cast<float>(side);
};
inline constexpr auto kFraction = [](const FieldShape&, std::size_t) { return kInitialBsdfFraction; };
inline constexpr auto kReach = [](const FieldShape& shape, std::size_t) {
    return inverse_reach_of(shape.extent, kUnknownDistance);
};

using enum ArrayExtent;
using enum OnSplit;
using enum ValidRange;

/// The arrays in the order of files.
// clang-format off
inline constexpr SpecList kAll{
    ArraySpec{"radiance", "radiance", Cell, Copy, Amount, kZero, [](auto& t) -> auto& { return t.radiance; }},
    ArraySpec{"visits", "visits", Cell, Divide, Any, kZero, [](auto& t) -> auto& { return t.visits; }},
    ArraySpec{"sums", "sum", Cell, Clear, Any, kZero, [](auto& t) -> auto& { return t.pending_sum; }},
    ArraySpec{"counts", "count", Cell, Clear, Any, kZero, [](auto& t) -> auto& { return t.pending_count; }},
    ArraySpec{"row table", "row table", Row, Copy, Cumulative, kUniform, [](auto& t) -> auto& { return t.row_cdf; }},
    ArraySpec{"column table", "column table", Cell, Copy, Cumulative, kUniform, [](auto& t) -> auto& { return t.column_cdf; }},
    ArraySpec{"mean radiance", "mean radiance", Volume, Copy, Amount, kZero, [](auto& t) -> auto& { return t.mean_radiance; }},
    ArraySpec{"sums of direct light", "sum of direct light", Volume, Clear, Any, kZero, [](auto& t) -> auto& { return t.pending_direct; }},
    ArraySpec{"counts of light samples", "count of light samples", Volume, Clear, Any, kZero, [](auto& t) -> auto& { return t.pending_direct_count; }},
    ArraySpec{"direct light", "direct light", Volume, Copy, Amount, kZero, [](auto& t) -> auto& { return t.direct; }},
    ArraySpec{"light samples", "light samples", Volume, Divide, Any, kZero, [](auto& t) -> auto& { return t.direct_count; }},
    ArraySpec{"sums of light by clusters", "sum of light by a cluster", LightCluster, Clear, Any, kZero, [](auto& t) -> auto& { return t.pending_cluster; }},
    ArraySpec{"light by clusters", "light by a cluster", LightCluster, Copy, Amount, kZero, [](auto& t) -> auto& { return t.cluster_light; }},
    ArraySpec{"choices of lights", "choice of lights", LightCluster, Copy, Choice, kZero, [](auto& t) -> auto& { return t.light_cdf; }},
    ArraySpec{"changes", "change", Volume, Copy, Amount, kZero, [](auto& t) -> auto& { return t.change; }},
    ArraySpec{"slopes of the mixture", "slope of the mixture", Volume, Clear, Any, kZero, [](auto& t) -> auto& { return t.pending_slope; }},
    ArraySpec{"curvatures of the mixture", "curvature of the mixture", Volume, Clear, NotNegative, kZero, [](auto& t) -> auto& { return t.pending_curvature; }},
    ArraySpec{"targets of the mixture", "target of the mixture", Volume, Halve, Finite, kZero, [](auto& t) -> auto& { return t.mixture_target; }},
    ArraySpec{"weights of the mixture", "weight of the mixture", Volume, Halve, Amount, kZero, [](auto& t) -> auto& { return t.mixture_weight; }},
    ArraySpec{"BSDF shares", "BSDF share", Volume, Copy, BsdfFraction, kFraction, [](auto& t) -> auto& { return t.bsdf_fraction; }},
    ArraySpec{"sums of distances", "sum of distances", Volume, Clear, Any, kZero, [](auto& t) -> auto& { return t.pending_distance; }},
    ArraySpec{"sums of light", "sum of light", Volume, Clear, Any, kZero, [](auto& t) -> auto& { return t.pending_light; }},
    ArraySpec{"distances of the reach", "distance of the reach", Volume, Halve, Amount, kZero, [](auto& t) -> auto& { return t.reach_distance; }},
    ArraySpec{"weights of the reach", "weight of the reach", Volume, Halve, Amount, kZero, [](auto& t) -> auto& { return t.reach_weight; }},
    ArraySpec{"inverse reaches", "inverse reach", Volume, Copy, Amount, kReach, [](auto& t) -> auto& { return t.inverse_reach; }},
};
// clang-format on

}  // namespace table_arrays

/// Calls fn(spec) for every array.
template <class Fn>
constexpr void for_each_table_array(Fn&& fn) {
    for_each_spec(table_arrays::kAll, fn);
}

/// Number of values of an array for this number of volumes.
inline std::size_t extent_of(ArrayExtent extent, const FieldShape& shape, std::size_t volumes) {
    const auto side = static_cast<std::size_t>(shape.cells.side);
    if (extent == ArrayExtent::Cell) return volumes * side * side;
    if (extent == ArrayExtent::LightCluster) return volumes * shape.light_clusters;
    return extent == ArrayExtent::Row ? volumes * side : volumes;
}

/// Calls fn(array of `from`, array of `to`) for every array; `to` is const if fn only reads it.
template <template <class> class From, class To, class Fn>
void zip(const TableArrays<From, From>& from, To& to, Fn&& fn) {
    for_each_table_array([&](const auto& spec) { fn(spec.get(from), spec.get(to)); });
}

/// Tables of volumes without training samples: uniform.
HostTables make_tables(const FieldShape& shape, std::size_t volumes);

/// Whether all arrays have the length that follows from the shape and the number of volumes.
bool fits(const FieldShape& shape, const HostTables& tables, std::size_t volumes);

/// Bytes of all arrays per volume. `light_clusters`: of the scene's light tree.
std::size_t table_bytes(int bins, std::size_t light_clusters = 0);
std::size_t field_bytes(const HostTables& tables);

inline std::size_t volume_count(const HostTables& tables) { return tables.mean_radiance.size(); }

/// Tables of a refined placement: each new volume, numbered after the others, begins with the table of its parent.
/// Counts of training samples are divided evenly between the two, cell by cell, since the child serves about half of
/// the points; none is lost or counted twice, and a cell left without training samples has no radiance. Pending sums
/// stay with the parent.
HostTables split_field(const FieldShape& shape, HostTables tables, std::span<const std::uint32_t> parents);

/// Views of the arrays for kernels that trace paths, for the update and for heat maps: overloads that code for any
/// representation calls, see field_model.h. `tables` may be empty for views of the placement.
template <template <class> class Array, template <class> class TableArray>
TableField field_view(const FieldShape& shape, const VolumeStorage<Array>& volumes,
                      TableStorage<TableArray>& tables) {
    TableField field;
    static_cast<PlacementView&>(field) = placement_view(volumes, shape.extent);
    field.cells = shape.cells;
    field.light_clusters = shape.light_clusters;
    field.radiance_unit = shape.radiance_unit;
    for_each_table_array([&](const auto& spec) { spec.get(field) = view_of(spec.get(tables)); });
    return field;
}

template <template <class> class Array>
TableUpdateView update_view(const FieldShape& shape, TableStorage<Array>& tables) {
    TableUpdateView view;
    view.cells = shape.cells;
    view.light_clusters = shape.light_clusters;
    view.radiance_unit = shape.radiance_unit;
    view.extent = shape.extent;
    view.rate = shape.rate;
    view.uniform_floor = shape.uniform_floor;
    for_each_table_array([&](const auto& spec) { spec.get(view) = view_of(spec.get(tables)); });
    return view;
}

template <template <class> class Array>
TableVolumeSummary summary_of(const FieldShape& shape, const HostVolumes&, TableStorage<Array>& tables) {
    return {update_view(shape, tables)};
}

}  // namespace pl
