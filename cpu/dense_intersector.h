// Rays against every triangle of a small scene, several rays at a time. Below some 64 triangles this beats any
// hierarchy: there is nothing to decide, so vectors are always full.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "core/kernel/scene/scene_view.h"
#include "cpu/dense_triangles.h"

namespace pl {

/// The loops compiled for one instruction set.
struct DenseKernel {
    std::string_view isa;
    DenseLoops loops;
};

/// Those that this build has and this machine can run, widest vectors last.
std::span<const DenseKernel> usable_dense_kernels();

/// Satisfies BatchIntersector. Hits are bit for bit those of intersect_triangle on every triangle in order of number,
/// whatever the instruction set. Triangles that no ray can hit, because two corners coincide, are left out.
class DenseIntersector {
public:
    /// Throws Error if the scene has more than kMaxDenseTriangles.
    explicit DenseIntersector(const SceneView& scene, DenseKernel kernel = usable_dense_kernels().back());

    void find_closest(RayBatch& batch, std::uint32_t count) const {
        kernel_.loops.find_closest(view(), batch.ray_groups(), batch.hit_groups(), group_count(count));
    }
    void find_occluded(RayBatch& batch, std::uint32_t count) const {
        kernel_.loops.find_occluded(view(), batch.ray_groups(), batch.occlusion_masks(), group_count(count));
    }
    std::string_view isa() const { return kernel_.isa; }

private:
    DenseView view() const;
    std::uint32_t number_of(Vec3f position);

    std::vector<Vec3f> positions_;
    std::vector<DenseTriangle> triangles_;
    DenseKernel kernel_;
};
static_assert(BatchIntersector<DenseIntersector>);

} // namespace pl
