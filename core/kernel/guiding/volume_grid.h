// Lookup of the volume that serves a point of a triangle in a few loads: the triangle's side, or the cell of the grid
// on it, lists the few volumes that can be nearest there. Returns the same volume as the search of volume_lookup.h
// for every point of make_surface_point(). Built by core/fields/volume_grid.h, which gives the conditions.
#pragma once

#include <bit>

#include "core/kernel/guiding/volume_lookup.h"
#include "core/kernel/scene/surface_point.h"

namespace pl {

/// The entry of a triangle's side, or of a point on it: a kind in the two highest bits, a number below.
class VolumePlace {
public:
    enum class Kind : std::uint32_t {
        Node,    ///< the volume of this tree node serves all points; kNone: no volume does
        Cell,    ///< the nearest volume of this cell
        Grid,    ///< the cell of this grid that holds the point
        Search,  ///< search the tree
    };
    static constexpr std::uint32_t kNumberBits = 30;
    static constexpr std::uint32_t kNone = (1u << kNumberBits) - 1;

    VolumePlace() = default;
    PL_HD constexpr VolumePlace(Kind kind, std::uint32_t number)
        : word_(static_cast<std::uint32_t>(kind) << kNumberBits | number) {}

    PL_HD constexpr Kind kind() const { return static_cast<Kind>(word_ >> kNumberBits); }
    PL_HD constexpr std::uint32_t number() const { return word_ & kNone; }

private:
    std::uint32_t word_ = 0;
};

/// The volumes that can be nearest to a point of a cell, as numbers of tree nodes: up to three in the word itself, or
/// a list.
class VolumeCell {
public:
    static constexpr int kMostNodes = 3;
    static constexpr int kNodeBits = 21;
    static constexpr std::uint32_t kMaxNode = (1u << kNodeBits) - 1;

    /// Search the tree.
    VolumeCell() = default;
    /// A cell of these nodes. Fewer than three are given with the last one repeated; none above kMaxNode.
    PL_HD constexpr VolumeCell(std::uint32_t a, std::uint32_t b, std::uint32_t c)
        : word_(a | std::uint64_t{b} << kNodeBits | std::uint64_t{c} << 2 * kNodeBits) {}
    /// A cell of the list that starts at this entry.
    static PL_HD constexpr VolumeCell list(std::uint32_t first) {
        VolumeCell cell;
        cell.word_ = kIsList | first;
        return cell;
    }

    PL_HD constexpr bool has_nodes() const { return (word_ & kIsList) == 0; }
    PL_HD constexpr bool has_list() const { return !has_nodes() && !is_searched(); }
    PL_HD constexpr bool is_searched() const { return word_ == kSearch; }
    PL_HD constexpr std::uint32_t node(int i) const {
        return static_cast<std::uint32_t>(word_ >> (i * kNodeBits)) & kMaxNode;
    }
    PL_HD constexpr std::uint32_t first_of_list() const { return static_cast<std::uint32_t>(word_); }
    /// Equal for equal cells only.
    PL_HD constexpr std::uint64_t word() const { return word_; }

private:
    static constexpr std::uint64_t kIsList = std::uint64_t{1} << 63;
    static constexpr std::uint64_t kSearch = ~std::uint64_t{0};

    std::uint64_t word_ = kSearch;
};

/// A grid over the side of a triangle: an affine map from space to cells, which lie row by row.
template <class N>
struct SideGridOf {
    Real3<N> x_axis;
    typename N::Real x_start;
    Real3<N> y_axis;
    typename N::Real y_start;
    typename N::Int first_cell, columns, rows;

    /// A position in units of cells.
    PL_INLINE Real2<N> coordinates(const Real3<N>& position) const {
        return {dot(x_axis, position) + x_start, dot(y_axis, position) + y_start};
    }
    /// Also false for coordinates that are not finite. Points of the triangle are inside.
    PL_INLINE typename N::Mask holds(const Real2<N>& at) const {
        return static_cast<typename N::Mask>((at.x >= 0.0f) & (at.y >= 0.0f) & (at.x < N::to_real(columns)) &
                                             (at.y < N::to_real(rows)));
    }
    /// Number of the cell at coordinates inside.
    PL_INLINE typename N::Int cell(const Real2<N>& at) const {
        return first_cell + N::truncate(at.y) * columns + N::truncate(at.x);
    }
};
using SideGrid = SideGridOf<One>;

/// Entries of lists are numbers of tree nodes, by ascending volume; this bit marks the last one.
inline constexpr std::uint32_t kLastOfList = 0x80000000u;

struct VolumeGridView {
    Span<const VolumePlace> sides;  ///< [triangle] fronts, then [triangle] backs
    Span<const SideGrid> grids;
    Span<const VolumeCell> cells;
    Span<const std::uint32_t> lists;

    /// Kind Node, Cell or Search. Reads neither nodes nor cells.
    PL_HD VolumePlace place_of(std::uint32_t primitive, bool front, Vec3f position) const {
        const std::uint32_t triangles = sides.count / 2;
        if (primitive >= triangles) return {VolumePlace::Kind::Search, 0};
        const VolumePlace side = sides[primitive + (front ? 0 : triangles)];
        if (side.kind() != VolumePlace::Kind::Grid) return side;
        const SideGrid& grid = grids[side.number()];
        const Real2<One> at = grid.coordinates(unpack(position));
        if (!grid.holds(at)) return {VolumePlace::Kind::Search, 0};
        return {VolumePlace::Kind::Cell, static_cast<std::uint32_t>(grid.cell(at))};
    }
};

/// The volume that serves a point, and the tree node that holds its position and normal, if the lookup read it.
struct FoundVolume {
    static constexpr std::uint32_t kUnknown = 0xffffffffu;

    std::int32_t volume = kNoVolume;
    std::uint32_t node = kUnknown;
};

/// The nearest volume so far, in one word: the squared distance above the number, so that the smaller word is nearer,
/// and of equal distances the lower number. Distances that are not finite never win.
class NearestWord {
public:
    PL_HD void consider(const KdTreeView& tree, std::uint32_t number, Vec3f position) {
        const KdNode node = tree.nodes[number];
        const float d2 = squared_distance(position, node.position);
        const std::uint64_t word = std::uint64_t{std::bit_cast<std::uint32_t>(d2)} << 32 | node.volume;
        node_ = word < word_ ? number : node_;
        word_ = min_of(word, word_);
    }
    PL_HD FoundVolume found() const { return {static_cast<std::int32_t>(static_cast<std::uint32_t>(word_)), node_}; }

private:
    std::uint64_t word_ = (std::uint64_t{std::bit_cast<std::uint32_t>(kInfinity)} << 32) - 1;  ///< number kNoVolume
    std::uint32_t node_ = FoundVolume::kUnknown;
};

/// The nearest volume of a cell that has nodes or a list.
PL_HD inline FoundVolume nearest_of_cell(const KdTreeView& tree, Span<const std::uint32_t> lists, VolumeCell cell,
                                         Vec3f position) {
    NearestWord nearest;
    if (cell.has_nodes()) {
        for (int i = 0; i < VolumeCell::kMostNodes; ++i) nearest.consider(tree, cell.node(i), position);
        return nearest.found();
    }
    for (std::uint32_t i = cell.first_of_list();; ++i) {
        nearest.consider(tree, lists[i] & ~kLastOfList, position);
        if ((lists[i] & kLastOfList) != 0) return nearest.found();
    }
}

/// Result of a lookup in a grid; without is_known the tree has to be searched.
struct GridAnswer {
    FoundVolume found;
    bool is_known = false;
};

PL_HD inline GridAnswer volume_at_place(const KdTreeView& tree, const VolumeGridView& grid, VolumePlace place,
                                        Vec3f position) {
    if (place.kind() == VolumePlace::Kind::Node) {
        if (place.number() == VolumePlace::kNone) return {{}, true};
        return {{static_cast<std::int32_t>(tree.nodes[place.number()].volume), place.number()}, true};
    }
    if (place.kind() == VolumePlace::Kind::Cell) {
        const VolumeCell cell = grid.cells[place.number()];
        if (!cell.is_searched()) return {nearest_of_cell(tree, grid.lists, cell, position), true};
    }
    return {};
}

/// The volume that serves a surface point, if there is one.
PL_HD inline FoundVolume find_volume(const KdTreeView& tree, const VolumeGridView& grid, const SurfacePoint& point) {
    const VolumePlace place = grid.place_of(point.primitive, point.front, point.position);
    const GridAnswer answer = volume_at_place(tree, grid, place, point.position);
    if (answer.is_known) return answer.found;
    return {.volume = find_volume(tree, point.position, point.geometric_normal)};
}

}  // namespace pl
