// Intersects rays with the instances of a scene, by a wide hierarchy over them and one of each mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "core/kernel/scene/instances.h"
#include "cpu/base/lane_kernels.h"
#include "cpu/rays/wide_hierarchy.h"

namespace pl {

/// Hits are bit-identical to those of find_instance_hit(), for every instruction set. Leaves are the scene's own
/// InstancesView::order and mesh_triangles.
class InstanceTracer {
public:
    /// There is an instance. Its arrays must outlive the tracer.
    explicit InstanceTracer(const InstancesView& instances, const LaneKernels& kernels = best_lane_kernels());

    /// Goes on from the hits of the first `count` rays among other triangles.
    void find_closest(RayBatch& batch, std::uint32_t count) const;
    void find_occluding(RayBatch& batch, std::uint32_t count) const;

    /// See BatchTracer. The nodes stay.
    void move_to(const InstancesView& instances) { instances_ = instances; }

private:
    WideInstances view() const;

    InstancesView instances_;
    LaneKernels kernels_;
    std::vector<WideNode> nodes_, mesh_nodes_;
    std::vector<std::uint32_t> roots_;  ///< [instance]: index into mesh_nodes_
};

}  // namespace pl
