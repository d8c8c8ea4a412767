// Embree finds the candidates, our own watertight test decides about them. Built only where Embree 3 or 4 is found.
#pragma once

#include <memory>
#include <string>

#include "core/kernel/scene/scene_view.h"
#include "cpu/ray_batch.h"

namespace pl {

/// Satisfies BatchIntersector. Every candidate that Embree offers is confirmed or refused by intersect_triangle, so
/// distances and barycentric weights are ours bit for bit, and source and target are excluded by number; a ray for
/// which ours refuses a candidate goes through our own hierarchy instead. What remains Embree's is which candidates it
/// offers: where two surfaces lie within rounding of each other it may settle for the one that our test places second,
/// and a ray within rounding of an edge may be offered nothing of a triangle that ours would hit.
class EmbreeIntersector {
public:
    /// Builds the hierarchy on `threads` threads. The scene's arrays must stay as long as this lives.
    EmbreeIntersector(const SceneView& scene, int threads);
    ~EmbreeIntersector();
    EmbreeIntersector(EmbreeIntersector&&) noexcept;
    EmbreeIntersector& operator=(EmbreeIntersector&&) noexcept;

    void find_closest(RayBatch& batch, std::uint32_t count) const;
    void find_occluded(RayBatch& batch, std::uint32_t count) const;

    /// See BatchTracer. Embree's own hierarchy has copies.
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
