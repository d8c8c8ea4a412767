// Moves subtrees of a finished hierarchy to places where they cost less.
#pragma once

#include "core/scene/build_bvh.h"

namespace pl {

/// Takes the largest nodes, one after the other, out of the hierarchy and puts each back where the sum of the areas of all nodes becomes
/// least, in several rounds. Splits from the root down cannot: none of them knows what those below it will find. The depth stays below
/// kMaxBvhDepth, and nodes and triangles are in depth-first order, as build_bvh() makes them. Deterministic.
/// [Bittner, Hapala and Havran 2013, "Fast Insertion-Based Optimization of Bounding Volume Hierarchies"; Meister and Bittner 2018,
/// "Parallel Reinsertion for Bounding Volume Hierarchy Optimization", for the search]
void reinsert_nodes(Bvh& bvh);

}  // namespace pl
