// Builds the bounding volume hierarchy that core/kernel/geometry/bvh_view.h traverses.
#pragma once

#include <vector>

#include "core/kernel/geometry/bvh_view.h"
#include "core/kernel/scene/scene_view.h"

namespace pl {

struct Bvh {
    std::vector<BvhNode> nodes;
    std::vector<std::uint32_t> primitives;
};

/// Binned surface-area heuristic, falling back to median splits where it finds none or would grow too deep.
/// Depth stays below kMaxBvhDepth for any input; the result does not depend on anything but the input.
/// [Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies"]
Bvh build_bvh(Span<const Vec3f> positions, Span<const Triangle> triangles);

}  // namespace pl
