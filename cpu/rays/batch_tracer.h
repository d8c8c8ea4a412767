// The intersectors of batches of rays: for scenes of a few triangles, for larger ones, and for instances. One is selected once per scene and
// called once per batch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/kernel/scene/scene_view.h"
#include "cpu/base/lane_kernels.h"
#include "cpu/rays/wide_hierarchy.h"

namespace pl {

/// Intersects a vector of rays with every triangle of a small scene. Up to about 64 triangles this is faster than any hierarchy: without
/// traversal the rays do not diverge, so vectors are always full. Satisfies BatchIntersector. Hits are bit-identical
/// to the hits of intersect_triangle on every triangle in ascending order, for every instruction set. Omits triangles
/// with two coincident corners, which no ray can hit.
class DenseIntersector {
public:
    static constexpr std::string_view kName = "dense";

    /// Throws Error if the scene has more than kMaxDenseTriangles.
    explicit DenseIntersector(const SceneView& scene, const LaneKernels& kernels = best_lane_kernels());

    void find_closest(RayBatch& batch, std::uint32_t count) const {
        kernels_.find_closest(view(), batch.ray_groups(), batch.hit_groups(), group_count(count));
    }
    void find_occluded(RayBatch& batch, std::uint32_t count) const {
        kernels_.find_occluded(view(), batch.ray_groups(), batch.occlusion_masks(), group_count(count));
    }
    /// See BatchTracer. No effect: positions and triangles are copies.
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

/// Intersects rays with scenes of any size by a hierarchy of eight children per node, several rays in turn if it is large. Satisfies
/// BatchIntersector. Hits are bit-identical to the hits of BvhIntersector, for every instruction set. Leaves of large
/// scenes are the scene's own BvhView::triangles.
class WideIntersector {
public:
    static constexpr std::string_view kName = "wide";
    /// Hierarchies and triangles up to this size are mostly answered by caches.
    static constexpr std::size_t kCacheBytes = std::size_t{1} << 24;

    /// The scene's arrays must outlive the intersector. Larger scenes than `cache_bytes` are traced several rays in
    /// turn.
    explicit WideIntersector(const SceneView& scene, const LaneKernels& kernels = best_lane_kernels(),
                             std::size_t cache_bytes = kCacheBytes)
        : nodes_(make_wide_nodes(scene.bvh)), bvh_(scene.bvh), kernels_(kernels),
          exceeds_caches_(bytes() + bvh_.triangles.count * sizeof(BvhTriangle) > cache_bytes) {
        if (!exceeds_caches_) blocks_ = make_leaf_blocks(nodes_, bvh_.triangles);
    }

    void find_closest(RayBatch& batch, std::uint32_t count) const;
    void find_occluded(RayBatch& batch, std::uint32_t count) const;

    /// See BatchTracer. The nodes stay.
    void move_to(const SceneView& scene) { bvh_ = scene.bvh; }
    /// Besides the scene's own arrays.
    std::size_t bytes() const { return nodes_.size() * sizeof(WideNode) + blocks_.size() * sizeof(LeafBlock); }
    std::string_view isa() const { return kernels_.isa; }

private:
    WideView view() const;

    std::vector<WideNode> nodes_;
    std::vector<LeafBlock> blocks_;  ///< unless the scene exceeds the caches
    BvhView bvh_;
    LaneKernels kernels_;
    bool exceeds_caches_;
};
static_assert(BatchIntersector<WideIntersector>);

/// Intersects rays with the instances of a scene, by a wide hierarchy over the instances and one of each mesh. Hits
/// are bit-identical to the hits of find_instance_hit(), for every instruction set. Leaves are the scene's own
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
