// The batch intersector of a scene: selected once per scene, called once per batch.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "cpu/rays/dense_intersector.h"
#include "cpu/rays/instance_tracer.h"
#include "cpu/rays/wide_intersector.h"

namespace pl {

/// Any of the batch intersectors behind one interface, and the instances of the scene. Dispatch is per batch, so its cost per ray is
/// negligible.
class BatchTracer {
public:
    /// Up to kMaxDenseTriangles every ray is tested with all of them, above that by the wide hierarchy.
    explicit BatchTracer(const SceneView& scene);

    void find_closest(RayBatch& batch, std::uint32_t count) const {
        std::visit([&](const auto& intersector) { intersector.find_closest(batch, count); }, intersector_);
        if (instances_) instances_->find_closest(batch, count);
    }
    void find_occluded(RayBatch& batch, std::uint32_t count) const {
        std::visit([&](const auto& intersector) { intersector.find_occluded(batch, count); }, intersector_);
        if (instances_) instances_->find_occluding(batch, count);
    }

    /// Reads the same triangles from other arrays, which must outlive the tracer; the previous ones may be freed.
    void move_to(const SceneView& scene) {
        std::visit([&](auto& intersector) { intersector.move_to(scene); }, intersector_);
        if (instances_) instances_->move_to(scene.instances);
    }

    /// Display name: "dense (avx512)", "wide (avx512)".
    std::string name() const;

private:
    using AnyIntersector = std::variant<DenseIntersector, WideIntersector>;
    static AnyIntersector choose(const SceneView& scene);

    AnyIntersector intersector_;               ///< of the triangles that are in the scene directly
    std::optional<InstanceTracer> instances_;  ///< traced afterwards
};
static_assert(BatchIntersector<BatchTracer>);

}  // namespace pl
