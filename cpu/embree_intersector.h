// Embree finds candidate triangles; the watertight test intersect_triangle accepts or rejects them. Embree 3 or 4.
#pragma once

#include <memory>
#include <string>

#include "core/kernel/scene/scene_view.h"
#include "cpu/ray_batch.h"

namespace pl {

/// Satisfies BatchIntersector. intersect_triangle accepts or rejects every candidate of Embree, so distances and
/// barycentric weights are bit-identical to those of the other intersectors, and source and target are excluded by
/// number. Rays with a rejected candidate traverse the scene's BVH instead. Two differences remain: of two surfaces
/// within rounding error of each other, Embree may report only the one that intersect_triangle places second; and it
/// may miss a triangle at an edge within rounding error.
class EmbreeIntersector {
public:
    /// Builds the hierarchy on `threads` threads. The scene's arrays must outlive the intersector.
    EmbreeIntersector(const SceneView& scene, int threads);
    ~EmbreeIntersector();
    EmbreeIntersector(EmbreeIntersector&&) noexcept;
    EmbreeIntersector& operator=(EmbreeIntersector&&) noexcept;

    void find_closest(RayBatch& batch, std::uint32_t count) const;
    void find_occluded(RayBatch& batch, std::uint32_t count) const;

    /// See BatchTracer. Embree's hierarchy holds copies of the positions.
    void move_to(const SceneView& scene) { scene_ = scene; }

    /// "3.13.5"
    static std::string version();

private:
    struct Handles;
    std::unique_ptr<Handles> handles_;
    SceneView scene_;
};
static_assert(BatchIntersector<EmbreeIntersector>);

}  // namespace pl
