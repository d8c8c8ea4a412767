// The surface points at the hits of a block of rays, found in SIMD lanes.
#pragma once

#include "cpu/base/lane_kernels.h"
#include "cpu/base/ray_batch.h"

namespace pl {

/// The operands of lanes that find surface points and no volumes.
inline PlacementRows rows_of(const SceneView& scene) {
    return {.triangles = scene.triangles.data, .planes = scene.planes.data, .positions = scene.positions.data};
}

/// The points of at most kPathBlock rays. Bit-identical to make_flat_point().
class SurfaceBlock {
public:
    explicit SurfaceBlock(const LaneKernels& kernels = best_lane_kernels()) : kernels_(kernels) {}

    /// Finds the surface points of rays [first, end); `first` is a multiple of kGroupSize. `rows`: of the scene.
    void find(const SceneView& scene, const PlacementRows& rows, const RayBatch& rays, std::uint32_t first,
              std::uint32_t end) {
        first_ = first;
        groups_ = has_surfaces(scene) ? pl::group_count(end - first) : 0;
        const std::uint32_t group = first / kGroupSize;
        kernels_.find_points(rows, rays.ray_groups() + group, rays.hit_groups() + group, points_, groups_);
    }
    /// Finds the points one by one, for scenes with instances. Apart: the same for all methods.
    template <FeatureSet F>
    [[gnu::noinline]] void find_singly(const SceneView& scene, const RayBatch& rays, std::uint32_t first,
                                       std::uint32_t end) {
        first_ = first;
        groups_ = pl::group_count(end - first);
        for (std::uint32_t ray = first; ray < end; ++ray)
            if (const Hit hit = rays.hit(ray); hit.found())
                points_[(ray - first) / kGroupSize].set((ray - first) % kGroupSize,
                                                        make_flat_point<F>(scene, hit, -rays.ray(ray).direction));
    }
    /// The points of ray `first` of find() and of the rays behind it; undefined for rays that miss.
    PointGroup* points() { return points_; }
    const PointGroup* points() const { return points_; }
    /// Number of groups with points.
    std::uint32_t group_count() const { return groups_; }

    /// The surface point with the geometric normal as shading normal.
    SurfacePoint flat_point(std::uint32_t ray, std::uint32_t primitive) const {
        const PointGroup& group = points_[(ray - first_) / kGroupSize];
        const std::uint32_t lane = (ray - first_) % kGroupSize;
        const Vec3f normal = group.geometric_normal.get(lane);
        return {.position = group.position.get(lane),
                .geometric_normal = normal,
                .shading_normal = normal,
                .position_error = group.position_error[lane],
                .primitive = primitive,
                .material = group.material[lane],
                .front = group.front[lane] != 0};
    }

private:
    LaneKernels kernels_;
    std::uint32_t first_ = 0;
    std::uint32_t groups_ = 0;
    PointGroup points_[kBlockGroups];
};

}  // namespace pl
