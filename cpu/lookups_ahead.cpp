#include "cpu/lookups_ahead.h"

#include <bit>

namespace pl {
namespace {

PlacementRows rows_of(const SceneView& scene, const PlacementView& placement) {
    const bool has_grid = placement.tree.lookup == Lookup::Grid;
    return {.triangles = scene.triangles.data,
            .planes = scene.planes.data,
            .positions = scene.positions.data,
            .sided_triangles = has_grid ? placement.grid.sides.count / 2 : 0,
            .sides = placement.grid.sides.data,
            .grids = placement.grid.grids.data,
            .cells = placement.grid.cells.data,
            .nodes = placement.tree.nodes.data};
}

}  // namespace

void LookupsAhead::begin(const SceneView& scene, const PlacementView& placement, const RayBatch& rays,
                         std::uint32_t first, std::uint32_t end) {
    first_ = first;
    groups_ = has_surfaces(scene) ? group_count(end - first) : 0;
    wanted_ = 0;
    const std::uint32_t group = first / kGroupSize;
    kernels_.find_points(rows_of(scene, placement), rays.ray_groups() + group, rays.hit_groups() + group, points_,
                         groups_);
    for (std::uint32_t i = 0; i < groups_; ++i) points_[i].cells = 0;
    for (std::uint32_t i = 0; i < end - first; ++i) {
        primitives_[i] = rays.hit(first + i).primitive;
        PointGroup& points = points_[i / kGroupSize];
        const std::uint32_t lane = i % kGroupSize;
        if (primitives_[i] == kNoPrimitive || !scene.materials[points.material[lane]].reflects()) continue;
        wanted_ |= std::uint64_t{1} << i;
        if (points.place[lane].kind() != VolumePlace::Kind::Cell) continue;
        points.cells |= 1u << lane;
        __builtin_prefetch(&placement.grid.cells[points.place[lane].number()]);
    }
}

void LookupsAhead::finish(const SceneView& scene, const PlacementView& placement) {
    const PlacementRows rows = rows_of(scene, placement);
    kernels_.read_cells(rows, points_, groups_);
    kernels_.find_nearest(rows, points_, groups_);
    std::uint64_t rest = wanted_;
    for (std::uint32_t i = 0; i < groups_; ++i) rest &= ~(std::uint64_t{points_[i].cells} << (i * kGroupSize));
    for (; rest != 0; rest &= rest - 1) {
        const auto i = static_cast<std::uint32_t>(std::countr_zero(rest));
        PointGroup& points = points_[i / kGroupSize];
        const std::uint32_t lane = i % kGroupSize;
        const GridAnswer answer =
            volume_at_place(placement.tree, placement.grid, points.place[lane], points.position.get(lane));
        const FoundVolume found = answer.is_known ? answer.found : placement.find(flat_point(i, primitives_[i]));
        points.volume[lane] = found.volume;
        points.node[lane] = found.node;
    }
}

}  // namespace pl
