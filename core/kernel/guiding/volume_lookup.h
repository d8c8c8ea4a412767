// The radiance volume that serves a surface point is the nearest with an agreeing normal; ties go to the lowest number. This is the
// search of a tree: it builds the grids on triangles (volume_grid.h), serves points for which these have no answer, and finds the
// several nearest. Tests hold both to the volume of a linear search.
#pragma once

#include <cstdint>

#include "core/kernel/base/math.h"
#include "core/kernel/base/span.h"

namespace pl {

inline constexpr std::int32_t kNoVolume = -1;

/// Cosine of the largest angle between the normals of a surface point and of the volume that serves it.
inline constexpr float kMinNormalCosine = 0.8f;

/// A volume as the search tree stores it; `axis` splits the node's range of the array. Aligned, so that a device reads it by 16
/// bytes.
struct alignas(16) KdNode {
    Vec3f position;
    std::uint32_t volume;
    Vec3f normal;
    std::uint32_t axis;
};
static_assert(sizeof(KdNode) == 32);

/// Balanced tree without pointers: the root of the range [low, high) is the entry in its middle, entries before it
/// are not larger along its axis, entries behind it not smaller.
struct KdTreeView {
    Span<const KdNode> nodes;
};

/// Ranges halve at every step, so 32 entries serve any 32-bit count.
inline constexpr int kMaxKdDepth = 32;

PL_HD inline float squared_distance(Vec3f a, Vec3f b) {
    const Vec3f d = a - b;
    return d.x * d.x + d.y * d.y + d.z * d.z;
}

PL_HD inline bool normals_agree(Vec3f a, Vec3f b) { return glm::dot(a, b) > kMinNormalCosine; }

/// The order of candidates: nearer first, then the lower number; it does not depend on the order of the search.
PL_HD inline bool is_nearer(float d2, std::int32_t volume, float other_d2, std::int32_t other_volume) {
    return d2 < other_d2 || (d2 == other_d2 && volume < other_volume);
}

/// Result of a nearest search.
struct Nearest {
    std::int32_t volume = kNoVolume;
    float distance2 = kInfinity;

    PL_HD void consider(const KdNode& node, Vec3f position, Vec3f normal) {
        const float d2 = squared_distance(position, node.position);
        const auto candidate = static_cast<std::int32_t>(node.volume);
        if (is_nearer(d2, candidate, distance2, volume) && normals_agree(normal, node.normal)) {
            distance2 = d2;
            volume = candidate;
        }
    }
    PL_HD float limit() const { return distance2; }
};

/// The `Count` nearest volumes, nearest first; for smooth interpolation in previews.
template <int Count>
struct NearestSeveral {
    std::int32_t volume[Count];
    float distance2[Count];
    int found = 0;

    PL_HD void consider(const KdNode& node, Vec3f position, Vec3f normal) {
        const float d2 = squared_distance(position, node.position);
        const auto candidate = static_cast<std::int32_t>(node.volume);
        if (found == Count && !is_nearer(d2, candidate, distance2[Count - 1], volume[Count - 1])) return;
        if (!(d2 < kInfinity) || !normals_agree(normal, node.normal)) return;
        int slot = found < Count ? found++ : Count - 1;
        for (; slot > 0 && is_nearer(d2, candidate, distance2[slot - 1], volume[slot - 1]); --slot) {
            volume[slot] = volume[slot - 1];
            distance2[slot] = distance2[slot - 1];
        }
        volume[slot] = candidate;
        distance2[slot] = d2;
    }
    PL_HD float limit() const { return found == Count ? distance2[Count - 1] : kInfinity; }
};

/// A component by its number; by comparisons, because indexed vectors come to the stack of a device.
PL_HD inline float component_of(Vec3f v, std::uint32_t axis) { return axis == 0 ? v.x : (axis == 1 ? v.y : v.z); }

/// Offers to `result` every volume that may belong to it. Subtrees are skipped only if they lie strictly beyond the
/// limit, so that ties are not missed: the plane distance never exceeds the computed distance of a point behind it,
/// because subtraction, multiplication and addition of non-negative numbers round monotonically.
template <class Result>
PL_HD inline void search_kd_tree(const KdTreeView& tree, Vec3f position, Vec3f normal, Result& result) {
    struct Range {
        std::uint32_t low, high;
    };
    // Ranges on the far side of a splitting plane, still to be searched; swapped ends mark a range above its node. None is empty.
    Range stack[kMaxKdDepth];
    int depth = 0;
    Range range{0, tree.nodes.count};
    while (true) {
        while (range.low < range.high) {
            const std::uint32_t middle = range.low + (range.high - range.low) / 2;
            const KdNode node = tree.nodes[middle];  // a copy: a device reads it by two loads of 16 bytes
            result.consider(node, position, normal);
            const Range below{range.low, middle};
            const Range above{middle + 1, range.high};
            const bool is_below = component_of(position, node.axis) - component_of(node.position, node.axis) < 0.0f;
            const Range far = is_below ? above : below;
            PL_ASSERT(depth < kMaxKdDepth);
            if (far.low < far.high) stack[depth++] = is_below ? Range{far.high, far.low} : far;
            range = is_below ? below : above;
        }
        float delta = 0.0f;
        do {
            if (depth == 0) return;
            const Range far = stack[--depth];
            const bool is_above = far.low > far.high;
            range = is_above ? Range{far.high, far.low} : far;
            const KdNode& node = tree.nodes[is_above ? range.low - 1 : range.high];
            delta = component_of(position, node.axis) - component_of(node.position, node.axis);
        } while (delta * delta > result.limit());
    }
}

/// The volume that serves a point given by position and normal alone, or kNoVolume.
PL_HD inline std::int32_t find_volume(const KdTreeView& tree, Vec3f position, Vec3f normal) {
    Nearest nearest;
    search_kd_tree(tree, position, normal, nearest);
    return nearest.volume;
}

}  // namespace pl
