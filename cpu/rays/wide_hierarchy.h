// The making of bounding volume hierarchies of eight children per node, for vectors: cpu/lanes/wide_lanes.h tests them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cpu/base/ray_batch.h"

namespace pl {

/// The nodes, root first, made from a two-wide hierarchy by the cut of it that costs least. Deterministic.
/// [Ylitie, Karras, Laine 2017, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs"]
std::vector<WideNode> make_wide_nodes(const BvhView& bvh);

/// The nodes of several hierarchies in one array, their roots first, in the order of `roots`. `roots`: nodes of `narrow`, whose children
/// have higher indices. `most`: entries of a leaf, at most kWideChildren.
std::vector<WideNode> make_wide_nodes(Span<const BvhNode> narrow, std::span<const std::uint32_t> roots,
                                      std::uint32_t most = kWideChildren);

/// Copies the triangles of all leaves, which then refer to blocks by number.
std::vector<LeafBlock> make_leaf_blocks(std::span<WideNode> nodes, Span<const BvhTriangle> triangles);

}  // namespace pl
