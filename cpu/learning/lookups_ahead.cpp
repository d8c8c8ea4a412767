#include "cpu/learning/lookups_ahead.h"

#include "cpu/base/groups.h"

namespace pl {
namespace {

PlacementRows rows_of(const SceneView& scene, const PlacementView& placement) {
    PlacementRows rows = rows_of(scene);
    rows.materials = scene.materials.data;
    rows.sided_triangles = placement.grid.sides.count / 2;
    rows.sides = placement.grid.sides.data;
    rows.grids = placement.grid.grids.data;
    rows.cells = placement.grid.cells.data;
    rows.nodes = placement.tree.nodes.data;
    return rows;
}

}  // namespace

void LookupsAhead::begin(const SceneView& scene, const PlacementView& placement, const RayBatch& rays,
                         std::uint32_t first, std::uint32_t end) {
    first_ = first;
    hits_ = rays.hit_groups() + first / kGroupSize;
    const PlacementRows rows = rows_of(scene, placement);
    surfaces_.find(scene, rows, rays, first, end);
    PointGroup* points = surfaces_.points();
    kernels_.mark_places(rows, hits_, points, surfaces_.group_count());
    wanted_ = 0;
    for (std::uint32_t i = 0; i < surfaces_.group_count(); ++i) {
        wanted_ |= std::uint64_t{points[i].wanted} << (i * kGroupSize);
        for_bits(points[i].cells, [&](std::uint32_t lane) {
            __builtin_prefetch(&placement.grid.cells[points[i].place[lane].number()]);
        });
    }
    wanted_ &= first_bits(end - first);
}

void LookupsAhead::finish(const SceneView& scene, const PlacementView& placement) {
    const PlacementRows rows = rows_of(scene, placement);
    PointGroup* all = surfaces_.points();
    const std::uint32_t groups = surfaces_.group_count();
    kernels_.read_cells(rows, all, groups);
    kernels_.find_nearest(rows, all, groups);
    std::uint64_t rest = wanted_;
    for (std::uint32_t i = 0; i < groups; ++i) rest &= ~(std::uint64_t{all[i].cells} << (i * kGroupSize));
    for_bits(rest, [&](std::uint32_t i) {
        PointGroup& points = all[i / kGroupSize];
        const std::uint32_t lane = i % kGroupSize;
        const GridAnswer answer =
            volume_at_place(placement.tree, placement.grid, points.place[lane], points.position.get(lane));
        const std::uint32_t primitive = hits_[i / kGroupSize].primitive[lane];
        const FoundVolume found =
            answer.is_known ? answer.found : placement.find(surfaces_.flat_point(first_ + i, primitive));
        points.volume[lane] = found.volume;
        points.node[lane] = found.node;
    });
}

}  // namespace pl
