// The batch intersector of a scene: selected once per scene, called once per batch.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "cpu/bvh_batch.h"
#include "cpu/dense_intersector.h"
#include "cpu/instance_tracer.h"
#include "cpu/wide_intersector.h"

namespace pl {

enum class IntersectorChoice;

/// Any of the batch intersectors behind one interface, and the instances of the scene. Dispatch is per batch, so its cost per ray is
/// negligible.
class BatchTracer {
public:
    /// Throws Error if the chosen intersector does not support the scene.
    BatchTracer(const SceneView& scene, IntersectorChoice choice);

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

    /// Display name: "dense (avx512)", "wide (avx512)", "bvh".
    std::string name() const;

private:
    using AnyIntersector = std::variant<BvhBatch, DenseIntersector, WideIntersector>;
    static AnyIntersector choose(const SceneView& scene, IntersectorChoice choice);

    AnyIntersector intersector_;               ///< of the triangles that are in the scene directly
    std::optional<InstanceTracer> instances_;  ///< traced afterwards
};
static_assert(BatchIntersector<BatchTracer>);

}  // namespace pl
