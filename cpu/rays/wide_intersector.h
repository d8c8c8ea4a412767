// Intersects rays with scenes of any size by a hierarchy of eight children per node, several rays in turn if it is
// large.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "core/kernel/scene/scene_view.h"
#include "cpu/base/lane_kernels.h"
#include "cpu/rays/wide_hierarchy.h"

namespace pl {

/// Satisfies BatchIntersector. Hits are bit-identical to those of BvhIntersector, for every instruction set. Leaves of large
/// scenes are the scene's own BvhView::triangles.
class WideIntersector {
public:
    /// Hierarchies and triangles up to this size are mostly answered by caches.
    static constexpr std::size_t kCacheBytes = std::size_t{1} << 24;

    /// The scene's arrays must outlive the intersector. Larger scenes than `cache_bytes` are traced several rays in
    /// turn.
    explicit WideIntersector(const SceneView& scene, const LaneKernels& kernels = best_lane_kernels(),
                             std::size_t cache_bytes = kCacheBytes)
        : nodes_(make_wide_nodes(scene.bvh)), bvh_(scene.bvh), kernels_(kernels),
          exceeds_caches_(bytes() + bvh_.triangles.count * sizeof(BvhTriangle) > cache_bytes) {
        if (!exceeds_caches_) blocks_ = make_leaf_blocks(nodes_, bvh_.triangles);
    }

    void find_closest(RayBatch& batch, std::uint32_t count) const;
    void find_occluded(RayBatch& batch, std::uint32_t count) const;

    /// See BatchTracer. The nodes stay.
    void move_to(const SceneView& scene) { bvh_ = scene.bvh; }
    /// Besides the scene's own arrays.
    std::size_t bytes() const { return nodes_.size() * sizeof(WideNode) + blocks_.size() * sizeof(LeafBlock); }
    std::string_view isa() const { return kernels_.isa; }

private:
    WideView view() const;

    std::vector<WideNode> nodes_;
    std::vector<LeafBlock> blocks_;  ///< unless the scene exceeds the caches
    BvhView bvh_;
    LaneKernels kernels_;
    bool exceeds_caches_;
};
static_assert(BatchIntersector<WideIntersector>);

}  // namespace pl
