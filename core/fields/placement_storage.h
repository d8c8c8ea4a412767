// Owners of the placement of the radiance volumes, written once for host and device memory. All methods share it.
#pragma once

#include "core/base/host_array.h"
#include "core/kernel/guiding/placement_view.h"

namespace pl {

/// Arrays of VolumeGridView; empty if positions are out of range: then all points are searched in the tree.
template <template <class> class Array>
struct VolumeGridStorage {
    Array<VolumePlace> sides;
    Array<SideGrid> grids;
    Array<VolumeCell> cells;
    Array<std::uint32_t> lists;
};

/// Arrays of PlacementView.
template <template <class> class Array>
struct VolumeStorage {
    Array<SurfacePoint> sites;  ///< [volume]
    Array<Vec3f> normals;       ///< [volume]
    Array<KdNode> kd_nodes;     ///< tree order, see KdTreeView
    VolumeGridStorage<Array> grid;
};

using HostVolumeGrid = VolumeGridStorage<HostArray>;
using HostVolumes = VolumeStorage<HostArray>;

/// Calls fn(array of `from`, array of `to`) for every array; `to` is const if fn only reads it.
template <template <class> class From, class To, class Fn>
void zip(const VolumeGridStorage<From>& from, To& to, Fn&& fn) {
    fn(from.sides, to.sides);
    fn(from.grids, to.grids);
    fn(from.cells, to.cells);
    fn(from.lists, to.lists);
}

/// All arrays without the grid, which follows from the other arrays and the scene: the content of field files.
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

template <template <class> class Array>
VolumeGridView grid_view(const VolumeGridStorage<Array>& grid) {
    return {.sides = view_of(grid.sides),
            .grids = view_of(grid.grids),
            .cells = view_of(grid.cells),
            .lists = view_of(grid.lists)};
}

template <template <class> class Array>
PlacementView placement_view(const VolumeStorage<Array>& volumes, float extent) {
    return {.tree = {.nodes = view_of(volumes.kd_nodes)},
            .grid = grid_view(volumes.grid),
            .normals = view_of(volumes.normals),
            .sites = view_of(volumes.sites),
            .extent = extent};
}

}  // namespace pl
