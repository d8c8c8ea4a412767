// Bounding volume hierarchy of eight children per node, for vectors: tested by cpu/lanes/wide_lanes.h.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/kernel/geometry/bvh_view.h"

namespace pl {

/// Most children of a node, and most triangles of a leaf.
inline constexpr std::uint32_t kWideChildren = 8;

/// Child of a node in one word: an inner node, or `count` entries of BvhView::triangles from `first` on.
struct WideReference {
    static constexpr std::uint32_t kCountBits = 4;

    std::uint32_t bits = 0;

    constexpr std::uint32_t first() const { return bits >> kCountBits; }
    constexpr std::uint32_t count() const { return bits & ((1u << kCountBits) - 1u); }  ///< 0: an inner node
};
static_assert(kMaxBvhTriangles <= 1u << (32 - WideReference::kCountBits));

/// The boxes of the children as rows of planes.
struct alignas(64) WideNode {
    float planes[3][2][kWideChildren];  ///< [axis][low or high]
    WideReference children[kWideChildren];
    std::uint32_t child_bits;  ///< bit i is set if there is child i
};

/// The triangles of a leaf as rows, for hierarchies that stay in the caches: memory for time. Beyond the last one it is repeated.
struct alignas(64) LeafBlock {
    float corners[3][3][kWideChildren];  ///< [corner][axis]
    std::uint32_t primitives[kWideChildren];
};

/// Entries of the stack of a traversal: every level of the two-wide hierarchy leaves at most the other children behind.
inline constexpr std::uint32_t kWideStack = (kWideChildren - 1) * kMaxBvhDepth;

/// The nodes, root first, made from a two-wide hierarchy by the cut of it that costs least. Deterministic.
/// [Ylitie, Karras, Laine 2017, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs"]
std::vector<WideNode> make_wide_nodes(const BvhView& bvh);

/// The same from any number of hierarchies in one array, the roots of all first, in the order of `roots`: nodes of `narrow`, whose
/// children have higher numbers. `most`: entries of a leaf, at most kWideChildren.
std::vector<WideNode> make_wide_nodes(Span<const BvhNode> narrow, std::span<const std::uint32_t> roots,
                                      std::uint32_t most = kWideChildren);

/// Copies the triangles of all leaves, which then refer to blocks by number.
std::vector<LeafBlock> make_leaf_blocks(std::span<WideNode> nodes, Span<const BvhTriangle> triangles);

}  // namespace pl
