#include "cpu/rays/instance_tracer.h"

#include <algorithm>

namespace pl {

InstanceTracer::InstanceTracer(const InstancesView& instances, const LaneKernels& kernels)
    : instances_(instances), kernels_(kernels) {
    constexpr std::uint32_t kRoot = 0;
    nodes_ = make_wide_nodes(instances.nodes, {&kRoot, 1}, 1);
    std::vector<std::uint32_t> meshes;  // their roots in the scene's nodes, ascending
    for (const Instance& instance : instances.list) meshes.push_back(instance.root);
    std::ranges::sort(meshes);
    meshes.erase(std::unique(meshes.begin(), meshes.end()), meshes.end());
    mesh_nodes_ = make_wide_nodes(instances.mesh_nodes, meshes);
    for (const Instance& instance : instances.list) {
        const auto place = std::ranges::lower_bound(meshes, instance.root);
        roots_.push_back(static_cast<std::uint32_t>(place - meshes.begin()));
    }
}

void InstanceTracer::find_closest(RayBatch& batch, std::uint32_t count) const {
    kernels_.find_closest_instances(view(), batch.ray_groups(), batch.hit_groups(), count);
}

void InstanceTracer::find_occluding(RayBatch& batch, std::uint32_t count) const {
    kernels_.find_occluding_instances(view(), batch.ray_groups(), batch.occlusion_masks(), count);
}

WideInstances InstanceTracer::view() const {
    return {.root = instances_.nodes[0],
            .nodes = nodes_.data(),
            .order = instances_.order.data,
            .list = instances_.list.data,
            .mesh_bounds = instances_.mesh_nodes.data,
            .roots = roots_.data(),
            .mesh_nodes = mesh_nodes_.data(),
            .mesh_triangles = instances_.mesh_triangles.data};
}

}  // namespace pl
