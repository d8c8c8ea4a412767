// Owners of the learned field's arrays, written once for host and device. Placement (shared by all methods) and
// tables (one set per learning method) are separate, because they live and die separately.
#pragma once

#include "core/base/host_array.h"
#include "core/base/large_array.h"
#include "core/kernel/fields/table_field.h"
#include "core/kernel/fields/update_volume.h"

namespace pl {

/// What decides the size and meaning of a field's tables.
struct FieldShape {
    DirectionCells cells;
    float radiance_unit = 1.0f;
    float extent = 0.0f;
    LearningRate rate = LearningRate::Forgetful;
    float uniform_floor = kUniformShare;
    Lookup lookup = Lookup::Grid;
};

/// What VolumeGridView looks into; empty unless it is used.
template <template <class> class Array>
struct VolumeGridStorage {
    Array<VolumePlace> sides;
    Array<SideGrid> grids;
    Array<VolumeCell> cells;
    Array<std::uint32_t> lists;
};

/// Where the volumes are, and what finds them.
template <template <class> class Array>
struct VolumeStorage {
    Array<SurfacePoint> sites;  ///< [volume]
    Array<Vec3f> normals;       ///< [volume]
    Array<KdNode> kd_nodes;     ///< tree order, see KdTreeView
    VolumeGridStorage<Array> grid;
};

/// What one method learned. Layouts as in TableField and TableUpdateView.
template <template <class> class Array>
struct TableStorage {
    Array<float> radiance;
    Array<std::uint32_t> visits;
    Array<std::int64_t> pending_sum;
    Array<std::uint32_t> pending_count;
    Array<float> row_cdf;
    Array<float> column_cdf;
    Array<float> mean_radiance;
    Array<float> change;
    Array<std::int64_t> pending_slope;
    Array<std::int64_t> pending_curvature;
    Array<float> mixture_target;
    Array<float> mixture_weight;
    Array<float> bsdf_fraction;
    Array<std::int64_t> pending_distance;
    Array<std::int64_t> pending_light;
    Array<float> reach_distance;
    Array<float> reach_weight;
    Array<float> inverse_reach;
};

using HostVolumeGrid = VolumeGridStorage<HostArray>;
using HostVolumes = VolumeStorage<HostArray>;
using HostTables = TableStorage<LargeArray>;

/// `to` is const where nothing is written.
template <template <class> class From, class To, class Fn>
void zip(const VolumeGridStorage<From>& from, To& to, Fn&& fn) {
    fn(from.sides, to.sides);
    fn(from.grids, to.grids);
    fn(from.cells, to.cells);
    fn(from.lists, to.lists);
}

/// All but the grid, which follows from the others and the scene: what files hold.
template <template <class> class From, class To, class Fn>
void zip_placement(const VolumeStorage<From>& from, To& to, Fn&& fn) {
    fn(from.sites, to.sites);
    fn(from.normals, to.normals);
    fn(from.kd_nodes, to.kd_nodes);
}

template <template <class> class From, class To, class Fn>
void zip(const VolumeStorage<From>& from, To& to, Fn&& fn) {
    zip_placement(from, to, fn);
    zip(from.grid, to.grid, fn);
}

template <template <class> class From, class To, class Fn>
void zip(const TableStorage<From>& from, To& to, Fn&& fn) {
    fn(from.radiance, to.radiance);
    fn(from.visits, to.visits);
    fn(from.pending_sum, to.pending_sum);
    fn(from.pending_count, to.pending_count);
    fn(from.row_cdf, to.row_cdf);
    fn(from.column_cdf, to.column_cdf);
    fn(from.mean_radiance, to.mean_radiance);
    fn(from.change, to.change);
    fn(from.pending_slope, to.pending_slope);
    fn(from.pending_curvature, to.pending_curvature);
    fn(from.mixture_target, to.mixture_target);
    fn(from.mixture_weight, to.mixture_weight);
    fn(from.bsdf_fraction, to.bsdf_fraction);
    fn(from.pending_distance, to.pending_distance);
    fn(from.pending_light, to.pending_light);
    fn(from.reach_distance, to.reach_distance);
    fn(from.reach_weight, to.reach_weight);
    fn(from.inverse_reach, to.inverse_reach);
}

template <template <class> class Array>
VolumeGridView grid_view(const VolumeGridStorage<Array>& grid) {
    return {.sides = view_of(grid.sides),
            .grids = view_of(grid.grids),
            .cells = view_of(grid.cells),
            .lists = view_of(grid.lists)};
}

/// What kernels read and record into during a pass.
template <template <class> class Array, template <class> class TableArray>
TableField table_field(const FieldShape& shape, const VolumeStorage<Array>& volumes,
                       TableStorage<TableArray>& tables) {
    const TableStorage<TableArray>& frozen = tables;
    return {.cells = shape.cells,
            .tree = {.nodes = view_of(volumes.kd_nodes), .lookup = shape.lookup},
            .grid = grid_view(volumes.grid),
            .normals = view_of(volumes.normals),
            .sites = view_of(volumes.sites),
            .row_cdf = view_of(frozen.row_cdf),
            .column_cdf = view_of(frozen.column_cdf),
            .mean_radiance = view_of(frozen.mean_radiance),
            .bsdf_fraction = view_of(frozen.bsdf_fraction),
            .inverse_reach = view_of(frozen.inverse_reach),
            .pending_sum = view_of(tables.pending_sum),
            .pending_count = view_of(tables.pending_count),
            .pending_slope = view_of(tables.pending_slope),
            .pending_curvature = view_of(tables.pending_curvature),
            .pending_distance = view_of(tables.pending_distance),
            .pending_light = view_of(tables.pending_light),
            .radiance_unit = shape.radiance_unit,
            .extent = shape.extent,
            .radiance = view_of(frozen.radiance),
            .visits = view_of(frozen.visits)};
}

/// What publication writes between passes.
template <template <class> class Array>
TableUpdateView table_update_view(const FieldShape& shape, TableStorage<Array>& tables) {
    return {.cells = shape.cells,
            .radiance_unit = shape.radiance_unit,
            .extent = shape.extent,
            .rate = shape.rate,
            .uniform_floor = shape.uniform_floor,
            .radiance = view_of(tables.radiance),
            .visits = view_of(tables.visits),
            .pending_sum = view_of(tables.pending_sum),
            .pending_count = view_of(tables.pending_count),
            .row_cdf = view_of(tables.row_cdf),
            .column_cdf = view_of(tables.column_cdf),
            .mean_radiance = view_of(tables.mean_radiance),
            .change = view_of(tables.change),
            .pending_slope = view_of(tables.pending_slope),
            .pending_curvature = view_of(tables.pending_curvature),
            .mixture_target = view_of(tables.mixture_target),
            .mixture_weight = view_of(tables.mixture_weight),
            .bsdf_fraction = view_of(tables.bsdf_fraction),
            .pending_distance = view_of(tables.pending_distance),
            .pending_light = view_of(tables.pending_light),
            .reach_distance = view_of(tables.reach_distance),
            .reach_weight = view_of(tables.reach_weight),
            .inverse_reach = view_of(tables.inverse_reach)};
}

}  // namespace pl
