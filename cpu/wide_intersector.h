// Intersects rays with scenes of any size by a hierarchy of eight children per node, several rays in turn if it is large.
#pragma once

#include <string_view>
#include <vector>

#include "core/kernel/scene/scene_view.h"
#include "cpu/lane_kernels.h"
#include "cpu/wide_hierarchy.h"

namespace pl {

/// Satisfies BatchIntersector. Hits are bit-identical to those of BvhIntersector, for every instruction set. Leaves are the
/// scene's own BvhView::triangles.
class WideIntersector {
public:
    /// The scene's arrays must outlive the intersector.
    explicit WideIntersector(const SceneView& scene, const LaneKernels& kernels = best_lane_kernels())
        : nodes_(make_wide_nodes(scene.bvh)), bvh_(scene.bvh), kernels_(kernels) {}

    void find_closest(RayBatch& batch, std::uint32_t count) const;
    void find_occluded(RayBatch& batch, std::uint32_t count) const;

    /// See BatchTracer. The nodes stay.
    void move_to(const SceneView& scene) { bvh_ = scene.bvh; }
    /// Of the nodes, besides the scene's own arrays.
    std::size_t bytes() const { return nodes_.size() * sizeof(WideNode); }
    std::string_view isa() const { return kernels_.isa; }

private:
    WideView view() const;

    std::vector<WideNode> nodes_;
    BvhView bvh_;
    LaneKernels kernels_;
};
static_assert(BatchIntersector<WideIntersector>);

}  // namespace pl
