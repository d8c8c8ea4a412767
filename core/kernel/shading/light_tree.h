// Light tree: a hierarchy over many lights that samples them by distance and orientation to the shaded point. [Conty
// Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting"] Occlusion is unknown to it: a
// choice among clusters of lights that was learned for the surroundings of a point is mixed with its own.
#pragma once

#include "core/kernel/base/math.h"
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

/// cos(max(0, a - b)) of two angles in [0, pi], given by their cosines.
PL_HD inline float cos_of_difference(float cos_a, float cos_b) {
    if (cos_a >= cos_b) return 1.0f;
    const float sin_product = (1.0f - cos_a * cos_a) * (1.0f - cos_b * cos_b);
    return cos_a * cos_b + std::sqrt(max_of(sin_product, 0.0f));
}

/// Importance of a node: power over squared distance, times a bound on the emission cosines of its lights; 0 if all
/// face away. Without the cosine at the receiver.   [Conty Estevez and Kulla 2018, section 5]
PL_HD inline float light_importance(const LightNode& node, Vec3f from) {
    const Vec3f to_point = from - node.center;
    const float distance2 = glm::dot(to_point, to_point);
    const float radius2 = node.radius * node.radius;
    if (distance2 <= radius2) return node.power / radius2;
    const float cos_point = clamp_to(glm::dot(node.axis, to_point) / std::sqrt(distance2), -1.0f, 1.0f);
    const float cos_sphere = std::sqrt(max_of(1.0f - radius2 / distance2, 0.0f));
    const float cos_light = cos_of_difference(cos_of_difference(cos_point, node.cos_spread), cos_sphere);
    return node.power * max_of(cos_light, 0.0f) / distance2;
}

/// Probability of descending to the first child: its share of the children's importance, or of their power if both
/// importances are 0.
PL_HD inline float first_child_share(const LightTree& tree, std::uint32_t parent, Vec3f from) {
    const LightNode first = tree.nodes[parent + 1];
    const LightNode second = tree.nodes[tree.nodes[parent].next];
    float a = light_importance(first, from);
    float b = light_importance(second, from);
    if (!(a + b > 0.0f) || !(a + b < kInfinity)) {
        a = first.power;
        b = second.power;
    }
    return a / (a + b);
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
struct WayByNumber {
    float u;  ///< in [0,1)

    PL_HD bool takes_second(float first_share) {
        const bool is_second = u >= first_share;
        if (is_second)
            enter(first_share, 1.0f - first_share);
        else
            enter(0.0f, first_share);
        return is_second;
    }
    /// The interval [begin, begin + size) that holds u becomes [0,1).
    PL_HD void enter(float begin, float size) {
        constexpr float kAlmostOne = 1.0f - 0x1p-24f;
        u = min_of((u - begin) / size, kAlmostOne);
    }
};

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
        const float share = first_child_share(tree, at.node, from);
        const bool is_second = way.takes_second(share);
        at.probability *= is_second ? 1.0f - share : share;
        at.node = is_second ? node.next : at.node + 1;
    }
}

/// Probability of a cluster: a mixture of the tree's and the learned one.
PL_HD inline float cluster_probability(LearnedLights learned, std::uint32_t cluster, float by_tree) {
    return kTreeShare * by_tree + (1.0f - kTreeShare) * learned.probability(cluster);
}

/// Samples a light for the point `from`, by the tree or by the mixture of it with a learned choice; u in [0,1).
PL_HD inline ChosenLight choose_light(const LightTree& tree, Vec3f from, float u, LearnedLights learned = {}) {
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
PL_HD inline float light_probability(const LightTree& tree, std::uint32_t light, Vec3f from,
                                     LearnedLights learned = {}) {
    WayByTrail way{tree.of_light[light].trail};
    if (learned.empty()) return descend<DescentEnd::Light>(tree, 0, from, way).probability;
    const LightDescent root = descend<DescentEnd::Cluster>(tree, 0, from, way);
    const LightDescent leaf = descend<DescentEnd::Light>(tree, root.node, from, way);
    return cluster_probability(learned, tree.of_light[light].cluster, root.probability) * leaf.probability;
}

}  // namespace pl
