// Light tree: a hierarchy over many lights that samples them by distance and orientation to the shaded point. [Conty
// Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting"] Occlusion is unknown to it: a
// choice among clusters of lights that was learned for the surroundings of a point is mixed with its own.
#pragma once

#include "core/kernel/base/numbers.h"
#include "core/kernel/base/span.h"
#include "core/kernel/base/warp.h"

namespace pl {

inline constexpr std::uint32_t kNoCluster = 0xffffffffu;
/// Most clusters of a tree.
inline constexpr std::uint32_t kMostLightClusters = 32;

/// Bounds of a set of lights: a sphere around them and a cone around the normals of their emitting sides. Aligned, so that a
/// device reads them by 16 bytes.
struct alignas(16) LightNode {
    Vec3f center{0.0f};
    float radius = 0.0f;
    Vec3f axis{0.0f, 0.0f, 1.0f};
    float cos_spread = 1.0f;  ///< cosine of the largest angle between axis and normal; -1 for all directions
    float power = 0.0f;       ///< sum of area x luminance of the emission, as a share of all lights
    std::uint32_t next = 0;   ///< inner node: its second child, the first one follows the parent; leaf: its light
    std::uint32_t is_leaf = 0;
    std::uint32_t cluster = kNoCluster;  ///< of which the node is the root
};
static_assert(sizeof(LightNode) == 48);

/// The leaf of a light.
struct LightPlace {
    std::uint64_t trail = 0;  ///< bit i: the path from the root takes the second child at level i
    /// Density of a point, given the light, per unit area, times the probability of sampling `lights`.
    float pdf_area = 0.0f;
    std::uint32_t cluster = 0;
};
/// Largest number of inner levels: the bits of a trail.
inline constexpr int kMostLightLevels = 64;

struct LightTree {
    Span<const LightNode> nodes;      ///< root first, depth-first order; empty if lights are few
    Span<const LightPlace> of_light;  ///< [light]
    /// The root of each cluster: nodes that together hold every light once. [cluster]
    Span<const std::uint32_t> clusters;

    PL_HD bool empty() const { return nodes.empty(); }
};

/// A light, and the probability of its choice.
struct ChosenLight {
    std::uint32_t light = 0;
    float probability = 0.0f;
};

/// The members of a LightNode that its importance depends on.
template <class N>
struct LightBounds {
    Real3<N> center;
    typename N::Real radius;
    Real3<N> axis;
    typename N::Real cos_spread, power;
};
/// Takes the node by value: a device then reads it by 16 bytes.
PL_HD inline LightBounds<One> bounds_of(LightNode node) {
    return {unpack(node.center), node.radius, unpack(node.axis), node.cos_spread, node.power};
}

/// cos(max(0, a - b)) of two angles in [0, pi], given by their cosines.
template <class N>
PL_INLINE typename N::Real cos_of_difference(const typename N::Real& cos_a, const typename N::Real& cos_b) {
    const auto sin_product = (1.0f - cos_a * cos_a) * (1.0f - cos_b * cos_b);
    const auto cosine = cos_a * cos_b + N::sqrt(max_real<N>(sin_product, 0.0f));
    return select(static_cast<typename N::Mask>(cos_a >= cos_b), N::constant(1.0f), cosine);
}

/// Importance of a node: power over squared distance, times a bound on the emission cosines of its lights; 0 if all
/// face away. Without the cosine at the receiver.   [Conty Estevez and Kulla 2018, section 5]
template <class N>
PL_INLINE typename N::Real light_importance(const LightBounds<N>& node, const Real3<N>& from) {
    const Real3<N> to_point = from - node.center;
    const auto distance2 = dot(to_point, to_point);
    const auto radius2 = node.radius * node.radius;
    const auto cos_point = clamp_real<N>(dot(node.axis, to_point) / N::sqrt(distance2), -1.0f, 1.0f);
    const auto cos_sphere = N::sqrt(max_real<N>(1.0f - radius2 / distance2, 0.0f));
    const auto cos_light = cos_of_difference<N>(cos_of_difference<N>(cos_point, node.cos_spread), cos_sphere);
    const auto outside = node.power * max_real<N>(cos_light, 0.0f) / distance2;
    return select(static_cast<typename N::Mask>(distance2 <= radius2), node.power / radius2, outside);
}

/// Probability of descending to the first of two children: its share of their importance, or of their power if both
/// importances are 0.
template <class N>
PL_INLINE typename N::Real first_child_share(const LightBounds<N>& first, const LightBounds<N>& second,
                                             const Real3<N>& from) {
    const auto a = light_importance(first, from);
    const auto b = light_importance(second, from);
    const auto usable = static_cast<typename N::Mask>((a + b > 0.0f) & (a + b < kInfinity));
    const auto share = select(usable, a, first.power);
    return share / (share + select(usable, b, second.power));
}

/// Learned probabilities of a tree's clusters for points near one of the scene.
struct LearnedLights {
    const float* cdf = nullptr;  ///< cumulative, ending in 1. [cluster]; null: nothing is learned

    PL_HD bool empty() const { return cdf == nullptr; }
    PL_HD float below(std::uint32_t cluster) const { return cluster > 0 ? cdf[cluster - 1] : 0.0f; }
    PL_HD float probability(std::uint32_t cluster) const { return cdf[cluster] - below(cluster); }
};

/// Share of light samples that the tree alone chooses where a choice is learned. A light sample weighs at most one over it
/// times its weight without learning, however wrong the learned choice is.
inline constexpr float kTreeShare = 0.25f;

/// A uniform number that makes one choice after another: rescaled to the part chosen, it is uniform again.
template <class N>
struct WayByNumberOf {
    typename N::Real u;  ///< in [0,1)

    PL_INLINE typename N::Mask takes_second(typename N::Real first_share) {
        const auto is_second = static_cast<typename N::Mask>(u >= first_share);
        enter(select(is_second, first_share, N::constant(0.0f)), select(is_second, 1.0f - first_share, first_share));
        return is_second;
    }
    /// The interval [begin, begin + size) that holds u becomes [0,1).
    PL_INLINE void enter(const typename N::Real& begin, const typename N::Real& size) {
        constexpr float kAlmostOne = 1.0f - 0x1p-24f;
        u = min_real<N>((u - begin) / size, kAlmostOne);
    }
};
using WayByNumber = WayByNumberOf<One>;

/// The way to a given light.
struct WayByTrail {
    std::uint64_t trail;

    PL_HD bool takes_second(float) {
        const bool is_second = (trail & 1) != 0;
        trail >>= 1;
        return is_second;
    }
};

enum class DescentEnd { Cluster, Light };

/// A node, and the probability of reaching it from the node where the descent began.
struct LightDescent {
    std::uint32_t node = 0;
    float probability = 1.0f;
};

template <DescentEnd End, class Way>
PL_HD inline LightDescent descend(const LightTree& tree, std::uint32_t begin, Vec3f from, Way& way) {
    LightDescent at{.node = begin};
    for (;;) {
        const LightNode& node = tree.nodes[at.node];
        if (End == DescentEnd::Cluster ? node.cluster != kNoCluster : node.is_leaf != 0) return at;
        const float share =
            first_child_share(bounds_of(tree.nodes[at.node + 1]), bounds_of(tree.nodes[node.next]), unpack(from));
        const bool is_second = way.takes_second(share);
        at.probability *= is_second ? 1.0f - share : share;
        at.node = is_second ? node.next : at.node + 1;
    }
}

/// Probability of a cluster: a mixture of the tree's and the learned one.
template <class Real>
PL_INLINE Real mix_cluster_probability(const Real& by_tree, const Real& learned) {
    return kTreeShare * by_tree + (1.0f - kTreeShare) * learned;
}
PL_HD inline float cluster_probability(LearnedLights learned, std::uint32_t cluster, float by_tree) {
    return mix_cluster_probability(by_tree, learned.probability(cluster));
}

/// Samples a light for the point `from`, by the tree or by the mixture of it with a learned choice; u in [0,1).
PL_HOST_APART PL_HD inline ChosenLight choose_light(const LightTree& tree, Vec3f from, float u,
                                                    LearnedLights learned = {}) {
    WayByNumber way{u};
    if (learned.empty()) {
        const LightDescent leaf = descend<DescentEnd::Light>(tree, 0, from, way);
        return {tree.nodes[leaf.node].next, leaf.probability};
    }
    LightDescent root;
    LightDescent leaf;
    if (way.takes_second(kTreeShare)) {
        const std::uint32_t cluster =
            find_interval(tree.clusters.count, way.u, [&](std::uint32_t i) { return learned.cdf[i]; });
        way.enter(learned.below(cluster), learned.probability(cluster));
        leaf = descend<DescentEnd::Light>(tree, tree.clusters[cluster], from, way);
        WayByTrail trail{tree.of_light[tree.nodes[leaf.node].next].trail};
        root = descend<DescentEnd::Cluster>(tree, 0, from, trail);
    } else {
        root = descend<DescentEnd::Cluster>(tree, 0, from, way);
        leaf = descend<DescentEnd::Light>(tree, root.node, from, way);
    }
    const float probability = cluster_probability(learned, tree.nodes[root.node].cluster, root.probability);
    return {tree.nodes[leaf.node].next, probability * leaf.probability};
}

/// Probability with which choose_light() returns this light.
PL_HOST_APART PL_HD inline float light_probability(const LightTree& tree, std::uint32_t light, Vec3f from,
                                                   LearnedLights learned = {}) {
    WayByTrail way{tree.of_light[light].trail};
    if (learned.empty()) return descend<DescentEnd::Light>(tree, 0, from, way).probability;
    const LightDescent root = descend<DescentEnd::Cluster>(tree, 0, from, way);
    const LightDescent leaf = descend<DescentEnd::Light>(tree, root.node, from, way);
    return cluster_probability(learned, tree.of_light[light].cluster, root.probability) * leaf.probability;
}

}  // namespace pl
