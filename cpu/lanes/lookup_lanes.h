// Surface points at hits, and the volumes that serve them, for vectors of rays. Included by one file per instruction set; see
// lanes.h. Bit-identical to make_flat_point(), VolumeGridView::place_of() and nearest_of_cell().
#pragma once

#include "cpu/lanes/group_rows.h"

namespace pl {
namespace {

class LookupLanes : GroupRows {
public:
    PL_INLINE LookupLanes(const PlacementRows& scene, std::uint32_t first) : GroupRows(first), scene_(scene) {}

    PL_INLINE void find_points(const RayGroup& rays, const HitGroup& hits, PointGroup& points) const {
        const LaneInt hit = integers(hits.primitive);
        const LaneInt primitive = select(hit == static_cast<std::int32_t>(kNoPrimitive), LaneInt{}, hit);
        const Words<Triangle> triangle(scene_.triangles, primitive);
        const Words<TrianglePlane> plane(scene_.planes, primitive);
        const CornersOf<Lanes> corners{load_vectors(scene_.positions, triangle.integer(offsetof(Triangle, v0))),
                                       load_vectors(scene_.positions, triangle.integer(offsetof(Triangle, v1))),
                                       load_vectors(scene_.positions, triangle.integer(offsetof(Triangle, v2)))};
        const LaneFloat margin = plane.real(offsetof(TrianglePlane, edge_margin));
        const Real3<Lanes> position = corners.at(inner_barycentrics<Lanes>(row(hits.b1), row(hits.b2), margin));
        const Real3<Lanes> normal = plane.vector(offsetof(TrianglePlane, normal));
        const Real3<Lanes> wo{-row(rays.direction_x), -row(rays.direction_y), -row(rays.direction_z)};
        const LaneInt front = dot(normal, wo) >= 0.0f;
        store(position, points.position);
        store(scaled(normal, select(front, broadcast(1.0f), broadcast(-1.0f))), points.geometric_normal);
        store(plane.real(offsetof(TrianglePlane, position_error)), points.position_error);
        store(triangle.integer(offsetof(Triangle, material)), points.material);
        store(front, points.front);
        store(place_of(primitive, front, position), reinterpret_cast<std::int32_t*>(points.place));
    }

    PL_INLINE void mark_places(const HitGroup& hits, PointGroup& points) const {
        const LaneInt is_hit = integers(hits.primitive) != static_cast<std::int32_t>(kNoPrimitive);
        const Words<Material> material(scene_.materials, integers(points.material));
        const LaneInt wanted = is_hit & ~is_black(material.vector(offsetof(Material, albedo)));
        const LaneInt is_cell = kind_of(integers(points.place)) == static_cast<std::int32_t>(VolumePlace::Kind::Cell);
        points.wanted |= mask_bits(wanted) << first();
        points.cells |= mask_bits(wanted & is_cell) << first();
    }

    PL_INLINE void read_cells(PointGroup& points, std::uint32_t& with_nodes) const {
        const LaneInt wanted = lanes_of(points.cells);
        const LaneInt number = integers(points.place) & static_cast<std::int32_t>(VolumePlace::kNone);
        const Words<VolumeCell> cell(scene_.cells, select(wanted, number, LaneInt{}));
        const auto low = std::bit_cast<LaneUint>(cell.integer(0));
        const auto high = std::bit_cast<LaneUint>(cell.integer(4));
        const LaneInt has_nodes = wanted & (std::bit_cast<LaneInt>(high) >= 0);  // see VolumeCell::has_nodes()
        const LaneUint nodes[] = {low & VolumeCell::kMaxNode,
                                  (low >> VolumeCell::kNodeBits | high << (32 - VolumeCell::kNodeBits)) &
                                      VolumeCell::kMaxNode,
                                  high >> (2 * VolumeCell::kNodeBits - 32) & VolumeCell::kMaxNode};
        for (int i = 0; i < VolumeCell::kMostNodes; ++i) {
            const LaneInt node = select(has_nodes, std::bit_cast<LaneInt>(nodes[i]), LaneInt{});
            store(node, points.nodes[i]);
            Lanes::prefetch(reinterpret_cast<const float*>(scene_.nodes), node * kNodeWords);
        }
        with_nodes |= mask_bits(has_nodes) << first();
    }

    PL_INLINE void find_nearest(PointGroup& points) const {
        const Real3<Lanes> position = vector(points.position);
        // The order of NearestWord: the squared distance decides, then the index; distances that are not finite never win.
        LaneUint distance = broadcast(std::bit_cast<std::uint32_t>(kInfinity) - 1u);
        LaneUint volume = broadcast(~0u);
        LaneInt nearest = Lanes::constant(static_cast<std::int32_t>(FoundVolume::kUnknown));
        for (const auto& nodes : points.nodes) {
            const LaneInt number = integers(nodes);
            const Words<KdNode> node(scene_.nodes, number);
            const Real3<Lanes> d = position - node.vector(offsetof(KdNode, position));
            const auto d2 = std::bit_cast<LaneUint>(dot(d, d));
            const auto candidate = std::bit_cast<LaneUint>(node.integer(offsetof(KdNode, volume)));
            const LaneInt wins = (d2 < distance) | ((d2 == distance) & (candidate < volume));
            distance = wins ? d2 : distance;
            volume = wins ? candidate : volume;
            nearest = wins ? number : nearest;
        }
        store(std::bit_cast<LaneInt>(volume), points.volume);
        store(nearest, points.node);
    }

private:
    static constexpr std::int32_t kNodeWords = sizeof(KdNode) / 4;

    PL_INLINE LaneInt place_of(const LaneInt& primitive, const LaneInt& front, const Real3<Lanes>& position) const {
        const auto triangles = static_cast<std::int32_t>(scene_.sided_triangles);
        const LaneInt has_side = primitive < triangles;
        const LaneInt search = Lanes::constant(word_of(VolumePlace::Kind::Search));
        if (triangles == 0) return search;
        const LaneInt number =
            select(has_side, primitive + select(front, LaneInt{}, Lanes::constant(triangles)), LaneInt{});
        const LaneInt side = select(has_side, Words<VolumePlace>(scene_.sides, number).integer(0), search);
        const LaneInt is_grid = kind_of(side) == static_cast<std::int32_t>(VolumePlace::Kind::Grid);
        if (!Lanes::any(is_grid)) return side;
        const LaneInt grid_number = side & static_cast<std::int32_t>(VolumePlace::kNone);
        const Words<SideGrid> of(scene_.grids, select(is_grid, grid_number, LaneInt{}));
        const SideGridOf<Lanes> grid{
            of.vector(offsetof(SideGrid, x_axis)),      of.real(offsetof(SideGrid, x_start)),
            of.vector(offsetof(SideGrid, y_axis)),      of.real(offsetof(SideGrid, y_start)),
            of.integer(offsetof(SideGrid, first_cell)), of.integer(offsetof(SideGrid, columns)),
            of.integer(offsetof(SideGrid, rows))};
        const Real2<Lanes> at = grid.coordinates(position);
        const LaneInt cell = grid.cell(at) | word_of(VolumePlace::Kind::Cell);
        return select(is_grid, select(grid.holds(at), cell, search), side);
    }

    /// A place of this kind with the number 0, and the kind of a place.
    static constexpr std::int32_t word_of(VolumePlace::Kind kind) {
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(kind) << VolumePlace::kNumberBits);
    }
    static PL_INLINE LaneInt kind_of(const LaneInt& place) {
        return std::bit_cast<LaneInt>(std::bit_cast<LaneUint>(place) >> VolumePlace::kNumberBits);
    }

    const PlacementRows& scene_;
};

/// Calls step(lanes, group) for every vector of every group.
template <class Step>
PL_INLINE void for_lookup_lanes(const PlacementRows& scene, std::uint32_t groups, const Step& step) {
    for (std::uint32_t group = 0; group < groups; ++group)
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth) step(LookupLanes(scene, first), group);
}

void read_cells(const PlacementRows& scene, PointGroup* points, std::uint32_t groups) {
    for (std::uint32_t group = 0; group < groups; ++group) {
        if (points[group].cells == 0) continue;  // there may be no cells at all
        std::uint32_t with_nodes = 0;
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
            LookupLanes(scene, first).read_cells(points[group], with_nodes);
        points[group].cells = with_nodes;
    }
}

void find_points(const PlacementRows& scene, const RayGroup* rays, const HitGroup* hits, PointGroup* points,
                 std::uint32_t groups) {
    for_lookup_lanes(scene, groups, [&](const LookupLanes& lanes, std::uint32_t group) {
        lanes.find_points(rays[group], hits[group], points[group]);
    });
}

void mark_places(const PlacementRows& scene, const HitGroup* hits, PointGroup* points, std::uint32_t groups) {
    for (std::uint32_t group = 0; group < groups; ++group) points[group].wanted = points[group].cells = 0;
    for_lookup_lanes(scene, groups, [&](const LookupLanes& lanes, std::uint32_t group) {
        lanes.mark_places(hits[group], points[group]);
    });
}

void find_nearest(const PlacementRows& scene, PointGroup* points, std::uint32_t groups) {
    for_lookup_lanes(scene, groups, [&](const LookupLanes& lanes, std::uint32_t group) {
        if (points[group].cells != 0) lanes.find_nearest(points[group]);
    });
}

}  // namespace
}  // namespace pl
