// The ray-casting interface of the kernels that trace paths: small scenes from shared memory, other ones by their hierarchy.
#pragma once

#include <cuda_runtime.h>

#include "core/kernel/geometry/intersector.h"
#include "core/kernel/geometry/postponed_traversal.h"
#include "core/kernel/geometry/small_scene.h"

/// Most triangles of a scene whose leaves are tested one after the other from shared memory, at most pl::kMostSmallTriangles; 0: no
/// scene's. And whether leaves of larger hierarchies are postponed. Set by the options of these names of the build, so that a
/// device can decide.
#ifndef PL_CUDA_SMALL_SCENES
#define PL_CUDA_SMALL_SCENES 64
#endif
#ifndef PL_CUDA_POSTPONE_LEAVES
#define PL_CUDA_POSTPONE_LEAVES 1
#endif

namespace pl::cuda {

inline constexpr std::uint32_t kSmallScenes = PL_CUDA_SMALL_SCENES;
inline constexpr bool kPostponesLeaves = PL_CUDA_POSTPONE_LEAVES != 0;
static_assert(kSmallScenes <= kMostSmallTriangles);

/// The leaves of a scene with at most kSmallScenes triangles in shared memory; on the host, which runs the threads of a block one
/// after the other, in place. None of any other scene. All threads of a block must call it.
__device__ inline SmallScene stage(const BvhView& bvh) {
    const std::uint32_t triangle_count = bvh.triangles.count <= kSmallScenes ? bvh.triangles.count : 0;
    const std::uint32_t leaf_count = triangle_count > 0 ? bvh.leaves.count : 0;
#ifdef __CUDA_ARCH__
    __shared__ alignas(BvhNode) std::byte root_bytes[sizeof(BvhNode)];
    __shared__ alignas(SmallLeaf) std::byte leaf_bytes[kMostSmallTriangles * sizeof(SmallLeaf)];
    __shared__ alignas(BvhTriangle) std::byte triangle_bytes[kMostSmallTriangles * sizeof(BvhTriangle)];
    auto* root = reinterpret_cast<BvhNode*>(root_bytes);
    auto* leaves = reinterpret_cast<SmallLeaf*>(leaf_bytes);
    auto* triangles = reinterpret_cast<BvhTriangle*>(triangle_bytes);
    if (leaf_count > 0 && threadIdx.x == 0) *root = bvh.nodes[0];
    for (std::uint32_t i = threadIdx.x; i < leaf_count; i += blockDim.x) leaves[i] = bvh.leaves[i];
    for (std::uint32_t i = threadIdx.x; i < triangle_count; i += blockDim.x) triangles[i] = bvh.triangles[i];
    __syncthreads();
    return {root, leaves, triangles, leaf_count};
#else
    return {bvh.nodes.data, bvh.leaves.data, bvh.triangles.data, leaf_count};
#endif
}

/// For kernels whose threads trace many rays. All threads of a block must construct it together.
template <FeatureSet F>
class SceneIntersector {
public:
    __device__ explicit SceneIntersector(const SceneView& scene)
        : bvh_(scene.bvh), small_(stage(scene.bvh)), instances_(scene.instances) {}

    __device__ Hit closest_hit(const Ray& ray) const { return find(ray, false); }
    __device__ bool occluded(const Ray& ray) const { return find(ray, true).found(); }

private:
    __device__ Hit find(const Ray& ray, bool any) const {
        Hit best = find_direct(ray, any);
        if constexpr (F.has(Feature::Instances)) {
            if (!instances_.empty()) find_instance_hit(instances_, ray, any, best);
        }
        return best;
    }
    /// Among the triangles that are in the scene directly.
    __device__ Hit find_direct(const Ray& ray, bool any) const {
        if (small_.leaf_count > 0) return find_hit(small_, ray, any);
        if constexpr (kPostponesLeaves)
            return find_hit(PostponingBvh{bvh_}, ray, any);
        else
            return find_hit(bvh_, ray, any);
    }

    const BvhView& bvh_;
    SmallScene small_;
    [[no_unique_address]] MemberIf<F.has(Feature::Instances), InstancesView> instances_;
};
static_assert(Intersector<SceneIntersector<kEveryFeature>>);

}  // namespace pl::cuda
