// Intersects a vector of rays with every triangle of a small scene. Up to about 64 triangles this is faster than any
// hierarchy: without traversal the rays do not diverge, so vectors are always full.
#pragma once

#include <string_view>
#include <vector>

#include "core/kernel/scene/scene_view.h"
#include "cpu/base/lane_kernels.h"

namespace pl {

/// Satisfies BatchIntersector. Hits are bit-identical to those of intersect_triangle on every triangle in ascending
/// order, for every instruction set. Omits triangles with two coincident corners, which no ray can hit.
class DenseIntersector {
public:
    /// Throws Error if the scene has more than kMaxDenseTriangles.
    explicit DenseIntersector(const SceneView& scene, const LaneKernels& kernels = best_lane_kernels());

    void find_closest(RayBatch& batch, std::uint32_t count) const {
        kernels_.find_closest(view(), batch.ray_groups(), batch.hit_groups(), group_count(count));
    }
    void find_occluded(RayBatch& batch, std::uint32_t count) const {
        kernels_.find_occluded(view(), batch.ray_groups(), batch.occlusion_masks(), group_count(count));
    }
    /// See BatchTracer. No effect: positions and triangles are copies.
    void move_to(const SceneView&) {}
    std::string_view isa() const { return kernels_.isa; }

private:
    DenseView view() const;
    std::uint32_t number_of(Vec3f position);

    std::vector<Vec3f> positions_;
    std::vector<DenseTriangle> triangles_;
    LaneKernels kernels_;
};
static_assert(BatchIntersector<DenseIntersector>);

}  // namespace pl
