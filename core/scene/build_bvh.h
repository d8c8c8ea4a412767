// Construction of the bounding volume hierarchy; core/kernel/geometry/bvh_view.h traverses it.
#pragma once

#include <vector>

#include "core/kernel/geometry/bvh_view.h"
#include "core/kernel/scene/scene_view.h"
#include "core/scene/bounds.h"

namespace pl {

struct Bvh {
    std::vector<BvhNode> nodes;
    std::vector<std::uint32_t> primitives;
};

/// Binned surface-area heuristic, along the axes of space and by the sizes of triangles, with median splits if it finds none or
/// the tree gets too deep. The depth is below kMaxBvhDepth for any input. The same to the bit for any number of threads; 0: all of
/// the machine. Throws Error(Input) for more than kMaxBvhTriangles.   [Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies"]
Bvh build_bvh(Span<const Vec3f> positions, Span<const Triangle> triangles, int threads = 0);

/// The same over boxes, for things that are more than a triangle: one to a leaf.
Bvh build_bvh(Span<const Bounds> boxes, int threads = 0);

}  // namespace pl
