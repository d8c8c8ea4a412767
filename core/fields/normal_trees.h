// Search trees by normal. On curved surfaces most volumes near a point have normals that do not agree with its own: a search of all
// volumes visits them in vain.
#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <vector>

#include "core/kernel/guiding/volume_lookup.h"

namespace pl {

/// For each cell of a cube map of normals a tree of the volumes that can agree with one of its normals, built when it is first
/// asked for. For several threads at once.
class NormalTrees {
    static constexpr std::size_t kSide = 6;  ///< cells along the edge of a face

public:
    static constexpr std::size_t kCells = 6 * kSide * kSide;

    /// The nodes must stay alive.
    explicit NormalTrees(Span<const KdNode> nodes);

    /// The cell of a unit normal.
    static std::size_t cell_of(Vec3f normal);
    /// A tree of all nodes whose normals agree with a normal of the cell, and of some others. Stays alive and the
    /// same.
    KdTreeView tree_of(std::size_t cell);
    /// The node of a volume among the nodes of the constructor.
    std::uint32_t node_of(std::uint32_t volume) const { return node_of_volume_[volume]; }
    const KdNode& node_at(std::uint32_t volume) const { return nodes_[node_of_volume_[volume]]; }

private:
    struct Tree {
        std::once_flag is_built;
        std::vector<KdNode> nodes;
    };

    Span<const KdNode> nodes_;
    std::vector<std::uint32_t> node_of_volume_;
    std::array<Tree, kCells> trees_;  ///< [face][row][column]
};

}  // namespace pl
