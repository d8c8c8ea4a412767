// Finds the volume that serves a point of a triangle in a few loads: the triangle's side, or the cell of the grid on
// it, names the few volumes that can be nearest there. Same answer as the searches of volume_lookup.h for every point
// that make_surface_point() makes; core/fields/volume_grid.h builds it and says why.
#pragma once

#include "core/kernel/fields/volume_lookup.h"
#include "core/kernel/scene/surface_point.h"

namespace pl {

/// What is known of a place, the side of a triangle or a cell on it: a kind in the two highest bits, a number below.
class VolumePlace {
public:
    enum class Kind : std::uint32_t {
        Volume,  ///< always this volume; the largest number says none
        List,    ///< the nearest of a list that starts at this entry
        Grid,    ///< look into this grid
        Search,  ///< search the tree
    };
    static constexpr std::uint32_t kNumberBits = 30;
    static constexpr std::uint32_t kMaxNumber = (1u << kNumberBits) - 1;

    VolumePlace() = default;
    PL_HD constexpr VolumePlace(Kind kind, std::uint32_t number)
        : word_(static_cast<std::uint32_t>(kind) << kNumberBits | number) {}

    PL_HD constexpr Kind kind() const { return static_cast<Kind>(word_ >> kNumberBits); }
    PL_HD constexpr std::uint32_t number() const { return word_ & kMaxNumber; }
    PL_HD constexpr std::int32_t volume() const {
        return number() == kMaxNumber ? kNoVolume : static_cast<std::int32_t>(number());
    }

private:
    std::uint32_t word_ = 0;
};

/// A grid over the side of a triangle: an affine map from space to cells, which lie row by row.
struct SideGrid {
    Vec3f x_axis;
    float x_start;
    Vec3f y_axis;
    float y_start;
    std::uint32_t first_cell;
    std::uint32_t columns;
    std::uint32_t rows;
};

/// Entries of lists are numbers of tree nodes, by ascending volume; the last one is marked.
inline constexpr std::uint32_t kLastOfList = 0x80000000u;

struct VolumeGridView {
    Span<const VolumePlace> sides;  ///< [triangle] fronts, then [triangle] backs
    Span<const SideGrid> grids;
    Span<const VolumePlace> cells;
    Span<const std::uint32_t> lists;

    PL_HD VolumePlace place_of(const SurfacePoint& point) const {
        const std::uint32_t triangles = sides.count / 2;
        if (point.primitive >= triangles) return {VolumePlace::Kind::Search, 0};
        const VolumePlace side = sides[point.primitive + (point.front ? 0 : triangles)];
        if (side.kind() != VolumePlace::Kind::Grid) return side;
        const SideGrid& grid = grids[side.number()];
        const float x = glm::dot(grid.x_axis, point.position) + grid.x_start;
        const float y = glm::dot(grid.y_axis, point.position) + grid.y_start;
        // Also catches positions that are not finite. Points of the triangle are inside.
        const bool inside =
            x >= 0.0f && y >= 0.0f && x < static_cast<float>(grid.columns) && y < static_cast<float>(grid.rows);
        if (!inside) return {VolumePlace::Kind::Search, 0};
        return cells[grid.first_cell + static_cast<std::uint32_t>(y) * grid.columns + static_cast<std::uint32_t>(x)];
    }
};

/// The nearest of the list that starts at entry `first`. Ascending volumes: of equal distances the first counts.
PL_HD inline std::int32_t nearest_of_list(const KdTreeView& tree, Span<const std::uint32_t> lists,
                                          std::uint32_t first, Vec3f position) {
    std::int32_t volume = kNoVolume;
    float distance2 = kInfinity;
    for (std::uint32_t i = first;; ++i) {
        const std::uint32_t entry = lists[i];
        const KdNode& node = tree.nodes[entry & ~kLastOfList];
        const float d2 = squared_distance(position, node.position);
        if (d2 < distance2) {
            distance2 = d2;
            volume = static_cast<std::int32_t>(node.volume);
        }
        if ((entry & kLastOfList) != 0) return volume;
    }
}

/// The volume that serves a surface point, or kNoVolume.
PL_HD inline std::int32_t find_volume(const KdTreeView& tree, const VolumeGridView& grid, const SurfacePoint& point) {
    if (tree.lookup == Lookup::Grid) {
        const VolumePlace place = grid.place_of(point);
        if (place.kind() == VolumePlace::Kind::Volume) return place.volume();
        if (place.kind() == VolumePlace::Kind::List)
            return nearest_of_list(tree, grid.lists, place.number(), point.position);
    }
    return find_volume(tree, point.position, point.geometric_normal);
}

}  // namespace pl
