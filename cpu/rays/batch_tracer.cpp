#include "cpu/rays/batch_tracer.h"

#include <algorithm>
#include <array>
#include <bit>

#include <fmt/format.h>

#include "core/base/error.h"

namespace pl {
namespace {

/// Bitwise equality: keeps 0 and -0 distinct, since merging them would save nothing.
bool same_bits(Vec3f a, Vec3f b) {
    using Bits = std::array<std::uint32_t, 3>;
    return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

}  // namespace

DenseIntersector::DenseIntersector(const SceneView& scene, const LaneKernels& kernels) : kernels_(kernels) {
    if (scene.direct_triangles() > kMaxDenseTriangles)
        throw Error(ErrorKind::Runtime, fmt::format("dense intersector: expected at most {} triangles, got {}",
                                                    kMaxDenseTriangles, scene.direct_triangles()));
    for (std::uint32_t i = 0; i < scene.direct_triangles(); ++i) {
        const Triangle& triangle = scene.triangles[i];
        const DenseTriangle dense{number_of(scene.positions[triangle.v0]), number_of(scene.positions[triangle.v1]),
                                  number_of(scene.positions[triangle.v2]), i};
        // With two coincident corners, edge functions are exactly opposite or zero: no ray passes the test.
        if (dense.a != dense.b && dense.b != dense.c && dense.c != dense.a) triangles_.push_back(dense);
    }
}

DenseView DenseIntersector::view() const {
    return {.positions = positions_.data(),
            .position_count = static_cast<std::uint32_t>(positions_.size()),
            .triangles = triangles_.data(),
            .triangle_count = static_cast<std::uint32_t>(triangles_.size())};
}

std::uint32_t DenseIntersector::number_of(Vec3f position) {
    for (std::uint32_t i = 0; i < positions_.size(); ++i)
        if (same_bits(positions_[i], position)) return i;
    positions_.push_back(position);
    return static_cast<std::uint32_t>(positions_.size() - 1);
}

void WideIntersector::find_closest(RayBatch& batch, std::uint32_t count) const {
    if (!nodes_.empty()) return kernels_.find_closest_wide(view(), batch.ray_groups(), batch.hit_groups(), count);
    for (std::uint32_t i = 0; i < count; ++i) batch.set_hit(i, {.t = batch.ray(i).t_max});
}

void WideIntersector::find_occluded(RayBatch& batch, std::uint32_t count) const {
    if (!nodes_.empty())
        return kernels_.find_occluded_wide(view(), batch.ray_groups(), batch.occlusion_masks(), count);
    for (std::uint32_t i = 0; i < count; ++i) batch.set_occluded(i, false);
}

WideView WideIntersector::view() const {
    return {.root = bvh_.nodes[0],
            .nodes = nodes_.data(),
            .triangles = bvh_.triangles.data,
            .blocks = exceeds_caches_ ? nullptr : blocks_.data()};
}

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

BatchTracer::BatchTracer(const SceneView& scene) : intersector_(choose(scene)) {
    if (!scene.instances.empty()) instances_.emplace(scene.instances);
}

BatchTracer::AnyIntersector BatchTracer::choose(const SceneView& scene) {
    if (scene.direct_triangles() <= kMaxDenseTriangles) return DenseIntersector(scene);
    return WideIntersector(scene);
}

std::string BatchTracer::name() const {
    return std::visit(
        [](const auto& intersector) { return fmt::format("{} ({})", intersector.kName, intersector.isa()); },
        intersector_);
}

}  // namespace pl
