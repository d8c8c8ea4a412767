// Rays and hits of a batch of paths in groups of 16, as structures of arrays: one row per component. The scenes that vectors of rays meet,
// as plain pointers: a few triangles, or hierarchies of eight children per node.
#pragma once

#include <concepts>
#include <cstdint>
#include <vector>

#include "core/kernel/geometry/bvh_view.h"
#include "core/kernel/geometry/ray.h"
#include "core/kernel/scene/instances.h"

namespace pl {

/// Rays per group: 16 floats fill one cache line, and one vector of the widest instruction set.
inline constexpr std::uint32_t kGroupSize = 16;

constexpr std::uint32_t group_count(std::uint32_t count) { return (count + kGroupSize - 1) / kGroupSize; }

/// Paths per block: their vertices fit into the L1 cache.
inline constexpr std::uint32_t kPathBlock = 64;
inline constexpr std::uint32_t kBlockGroups = group_count(kPathBlock);

/// 16 rays. Lanes that were never set hold the default ray.
struct alignas(64) RayGroup {
    float origin_x[kGroupSize] = {}, origin_y[kGroupSize] = {}, origin_z[kGroupSize] = {};
    float direction_x[kGroupSize] = {}, direction_y[kGroupSize] = {}, direction_z[kGroupSize] = {};
    float t_max[kGroupSize] = {};
    std::uint32_t source[kGroupSize] = {}, target[kGroupSize] = {};

    RayGroup() {
        for (std::uint32_t lane = 0; lane < kGroupSize; ++lane) set(lane, Ray{});
    }
    void set(std::uint32_t lane, const Ray& ray) {
        origin_x[lane] = ray.origin.x;
        origin_y[lane] = ray.origin.y;
        origin_z[lane] = ray.origin.z;
        direction_x[lane] = ray.direction.x;
        direction_y[lane] = ray.direction.y;
        direction_z[lane] = ray.direction.z;
        t_max[lane] = ray.t_max;
        source[lane] = ray.source;
        target[lane] = ray.target;
    }
    Ray get(std::uint32_t lane) const {
        return {.origin = {origin_x[lane], origin_y[lane], origin_z[lane]},
                .direction = {direction_x[lane], direction_y[lane], direction_z[lane]},
                .t_max = t_max[lane],
                .source = source[lane],
                .target = target[lane]};
    }
};

/// The closest hits of 16 rays.
struct alignas(64) HitGroup {
    float t[kGroupSize];
    std::uint32_t primitive[kGroupSize];
    float b1[kGroupSize], b2[kGroupSize];

    void set(std::uint32_t lane, const Hit& hit) {
        t[lane] = hit.t;
        primitive[lane] = hit.primitive;
        b1[lane] = hit.b1;
        b2[lane] = hit.b2;
    }
    Hit get(std::uint32_t lane) const { return {t[lane], primitive[lane], b1[lane], b2[lane]}; }
};

/// Bit `lane` is set if the ray of that lane is occluded.
using OcclusionMask = std::uint16_t;

/// A batch of rays and their hits.
class RayBatch {
public:
    explicit RayBatch(std::uint32_t capacity)
        : rays_(group_count(capacity)), hits_(group_count(capacity)), occluded_(group_count(capacity)) {}

    void set_ray(std::uint32_t index, const Ray& ray) { rays_[index / kGroupSize].set(index % kGroupSize, ray); }
    Ray ray(std::uint32_t index) const { return rays_[index / kGroupSize].get(index % kGroupSize); }
    void set_hit(std::uint32_t index, const Hit& hit) { hits_[index / kGroupSize].set(index % kGroupSize, hit); }
    std::uint32_t primitive(std::uint32_t index) const {
        return hits_[index / kGroupSize].primitive[index % kGroupSize];
    }
    Hit hit(std::uint32_t index) const { return hits_[index / kGroupSize].get(index % kGroupSize); }
    void set_occluded(std::uint32_t index, bool occluded) {
        const auto bit = static_cast<OcclusionMask>(1u << (index % kGroupSize));
        OcclusionMask& mask = occluded_[index / kGroupSize];
        mask = static_cast<OcclusionMask>(occluded ? mask | bit : mask & ~bit);
    }
    bool occluded(std::uint32_t index) const {
        return ((occluded_[index / kGroupSize] >> (index % kGroupSize)) & 1u) != 0;
    }

    RayGroup* ray_groups() { return rays_.data(); }
    const RayGroup* ray_groups() const { return rays_.data(); }
    HitGroup* hit_groups() { return hits_.data(); }
    const HitGroup* hit_groups() const { return hits_.data(); }
    OcclusionMask* occlusion_masks() { return occluded_.data(); }

private:
    std::vector<RayGroup> rays_;
    std::vector<HitGroup> hits_;
    std::vector<OcclusionMask> occluded_;
};

/// Intersects the first `count` rays of a batch. Results equal the results of an Intersector for each single ray.
template <class T>
concept BatchIntersector = requires(const T& intersector, RayBatch& batch, std::uint32_t count) {
    { intersector.find_closest(batch, count) } -> std::same_as<void>;
    { intersector.find_occluded(batch, count) } -> std::same_as<void>;
};

inline constexpr std::uint32_t kMaxDenseTriangles = 64;
inline constexpr std::uint32_t kMaxDensePositions = 3 * kMaxDenseTriangles;

struct DenseTriangle {
    std::uint32_t a, b, c;    ///< indices into DenseView::positions
    std::uint32_t primitive;  ///< index of the triangle in the scene
};

/// A small scene as plain pointers: files compiled for one instruction set must not instantiate inline functions of
/// containers, which the linker would merge with the inline functions of other files.
struct DenseView {
    const Vec3f* positions;  ///< without duplicates
    std::uint32_t position_count;
    const DenseTriangle* triangles;  ///< in ascending order of primitive
    std::uint32_t triangle_count;
};

/// Most children of a node, and most triangles of a leaf.
inline constexpr std::uint32_t kWideChildren = 8;

/// Child of a node in one word: an inner node, or `count` entries of BvhView::triangles from `first` on.
struct WideReference {
    static constexpr std::uint32_t kCountBits = 4;

    std::uint32_t bits = 0;

    constexpr std::uint32_t first() const { return bits >> kCountBits; }
    constexpr std::uint32_t count() const { return bits & ((1u << kCountBits) - 1u); }  ///< 0: an inner node
};
static_assert(kMaxBvhTriangles <= 1u << (32 - WideReference::kCountBits));

/// A node of a bounding volume hierarchy for vectors: the boxes of its children as rows of planes.
struct alignas(64) WideNode {
    float planes[3][2][kWideChildren];  ///< [axis][low or high]
    WideReference children[kWideChildren];
    std::uint32_t child_bits;  ///< bit i is set if there is child i
};

/// The triangles of a leaf as rows, for hierarchies that stay in the caches: memory for time. Beyond the last one it is repeated.
struct alignas(64) LeafBlock {
    float corners[3][3][kWideChildren];  ///< [corner][axis]
    std::uint32_t primitives[kWideChildren];
};

/// Entries of the stack of a traversal: every level of the two-wide hierarchy leaves at most the other children behind.
inline constexpr std::uint32_t kWideStack = (kWideChildren - 1) * kMaxBvhDepth;

/// A scene and its wide hierarchy as plain pointers.
struct WideView {
    BvhNode root;           ///< the bounds of the scene
    const WideNode* nodes;  ///< at least one
    const BvhTriangle* triangles;
    const LeafBlock* blocks;  ///< nullptr: the scene exceeds the caches, and leaves are its triangles
};

/// The instances of a scene and their wide hierarchies as plain pointers.
struct WideInstances {
    BvhNode root;           ///< the bounds of all
    const WideNode* nodes;  ///< over `order`, at least one; an instance to a leaf
    const std::uint32_t* order;
    const Instance* list;
    const BvhNode* mesh_bounds;  ///< [Instance::root]
    const std::uint32_t* roots;  ///< [instance]: of its mesh, in mesh_nodes
    const WideNode* mesh_nodes;
    const BvhTriangle* mesh_triangles;
};

}  // namespace pl
