// Light tree: a hierarchy over many lights that samples them by distance and orientation to the shaded point. [Conty
// Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting"]
#pragma once

#include "core/kernel/base/math.h"
#include "core/kernel/base/span.h"

namespace pl {

/// Bounds of a set of lights: a sphere around them and a cone around the normals of their emitting sides.
struct LightNode {
    Vec3f center{0.0f};
    float radius = 0.0f;
    Vec3f axis{0.0f, 0.0f, 1.0f};
    float cos_spread = 1.0f;  ///< cosine of the largest angle between axis and normal; -1 for all directions
    float power = 0.0f;       ///< sum of area x luminance of the emission, as a share of all lights
    std::uint32_t next = 0;   ///< inner node: its second child, the first one follows the parent; leaf: its light
    std::uint32_t is_leaf = 0;
};

/// The leaf of a light.
struct LightPlace {
    std::uint64_t trail = 0;  ///< bit i: the path from the root takes the second child at level i
    /// Density of a point, given the light, per unit area, times the probability of sampling `lights`.
    float pdf_area = 0.0f;
};
/// Largest number of inner levels: the bits of a trail.
inline constexpr int kMostLightLevels = 64;

struct LightTree {
    Span<const LightNode> nodes;      ///< root first, depth-first order; empty if lights are few
    Span<const LightPlace> of_light;  ///< [light]

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
    const LightNode& first = tree.nodes[parent + 1];
    const LightNode& second = tree.nodes[tree.nodes[parent].next];
    float a = light_importance(first, from);
    float b = light_importance(second, from);
    if (!(a + b > 0.0f) || !(a + b < kInfinity)) {
        a = first.power;
        b = second.power;
    }
    return a / (a + b);
}

/// Samples a light for the point `from`; u in [0,1).
PL_HD inline ChosenLight choose_light(const LightTree& tree, Vec3f from, float u) {
    constexpr float kAlmostOne = 1.0f - 0x1p-24f;
    ChosenLight chosen{.probability = 1.0f};
    std::uint32_t node = 0;
    while (tree.nodes[node].is_leaf == 0) {
        const float share = first_child_share(tree, node, from);
        const bool is_second = u >= share;
        const float part = is_second ? 1.0f - share : share;
        // The remainder of u is uniform again: it is reused.
        u = min_of((is_second ? u - share : u) / part, kAlmostOne);
        chosen.probability *= part;
        node = is_second ? tree.nodes[node].next : node + 1;
    }
    chosen.light = tree.nodes[node].next;
    return chosen;
}

/// Probability with which choose_light() returns this light.
PL_HD inline float light_probability(const LightTree& tree, std::uint32_t light, Vec3f from) {
    float probability = 1.0f;
    std::uint64_t trail = tree.of_light[light].trail;
    for (std::uint32_t node = 0; tree.nodes[node].is_leaf == 0; trail >>= 1) {
        const float share = first_child_share(tree, node, from);
        const bool is_second = (trail & 1) != 0;
        probability *= is_second ? 1.0f - share : share;
        node = is_second ? tree.nodes[node].next : node + 1;
    }
    return probability;
}

}  // namespace pl
