// A tree over the lights of a scene that has many: from any point, lights that are near and face it are chosen more
// often than others.   [Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting"]
#pragma once

#include "core/kernel/base/math.h"
#include "core/kernel/base/span.h"

namespace pl {

/// Some lights: a sphere around them and a cone around the normals of the sides that emit.
struct LightNode {
    Vec3f center{0.0f};
    float radius = 0.0f;
    Vec3f axis{0.0f, 0.0f, 1.0f};
    float cos_spread = 1.0f;  ///< of the angle between the axis and the farthest normal; -1 where all sides emit
    float power = 0.0f;       ///< area x luminance of the emission, as a share of that of all lights
    std::uint32_t next = 0;   ///< of an inner node, its second child; the first one follows it. Of a leaf, its light
    std::uint32_t is_leaf = 0;
};

/// How a light is found in the tree.
struct LightPlace {
    std::uint64_t trail = 0;  ///< bit i: whether the way down from level i goes to the second child
    float pdf_area = 0.0f;  ///< density of its points once it is chosen, per unit area, times the share of all light
                            ///< samples that choose among these lights
};
/// Levels of inner nodes that a trail can describe.
inline constexpr int kMostLightLevels = 64;

struct LightTree {
    Span<const LightNode> nodes;      ///< the root first; empty where there are few lights
    Span<const LightPlace> of_light;  ///< [light]

    PL_HD bool empty() const { return nodes.empty(); }
};

/// A light, and the probability with which it is chosen.
struct ChosenLight {
    std::uint32_t light = 0;
    float probability = 0.0f;
};

/// Cosine of the angle a - b, or 1 if it is negative; both in [0, pi], given by their cosines.
PL_HD inline float cos_of_difference(float cos_a, float cos_b) {
    if (cos_a >= cos_b) return 1.0f;
    const float sin_product = (1.0f - cos_a * cos_a) * (1.0f - cos_b * cos_b);
    return cos_a * cos_b + std::sqrt(max_of(sin_product, 0.0f));
}

/// Estimate of the irradiance that a node's lights cause at a point that faces them: power over squared distance, times the
/// largest cosine that any of them can have. 0 where all face away.   [Conty Estevez and Kulla 2018, section 5]
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

/// Probability of going on to a node's first child. Where nothing is known of either, their powers decide.
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

/// Chooses a light for a point; u in [0,1).
PL_HD inline ChosenLight choose_light(const LightTree& tree, Vec3f from, float u) {
    constexpr float kAlmostOne = 1.0f - 0x1p-24f;
    ChosenLight chosen{.probability = 1.0f};
    std::uint32_t node = 0;
    while (tree.nodes[node].is_leaf == 0) {
        const float share = first_child_share(tree, node, from);
        const bool is_second = u >= share;
        const float part = is_second ? 1.0f - share : share;
        // What is left of u is uniform again.
        u = min_of((is_second ? u - share : u) / part, kAlmostOne);
        chosen.probability *= part;
        node = is_second ? tree.nodes[node].next : node + 1;
    }
    chosen.light = tree.nodes[node].next;
    return chosen;
}

/// Probability with which choose_light() chooses a light for a point.
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
