// Rays against every triangle of a small scene, several rays at a time. Below some 64 triangles this beats any
// hierarchy: there is nothing to decide, so vectors are always full.
#pragma once

#include <string_view>
#include <vector>

#include "core/kernel/scene/scene_view.h"
#include "cpu/lane_kernels.h"

namespace pl {

/// Satisfies BatchIntersector. Hits are bit for bit those of intersect_triangle on every triangle in order of number,
/// whatever the instruction set. Triangles that no ray can hit, because two corners coincide, are left out.
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
    /// See BatchTracer. It has copies of its own.
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
