// The search of all volumes one after the other: the reference for the tests and timings of the tree and the grids.
#pragma once

#include "core/kernel/guiding/volume_lookup.h"

namespace pl::test {

/// The volume of a point given by position and normal, or kNoVolume.
inline std::int32_t find_volume_by_all(Span<const KdNode> nodes, Vec3f position, Vec3f normal) {
    Nearest nearest;
    for (const KdNode& node : nodes) nearest.consider(node, position, normal);
    return nearest.volume;
}

}  // namespace pl::test
