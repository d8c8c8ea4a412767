// The choice of lights by a light tree for a vector of receivers. Included by one file per instruction set; see lanes.h. Bit-identical to
// choose_light().
#pragma once

#include "cpu/group_rows.h"

namespace pl {
namespace {

/// A vector of receivers on their way down the tree. A choice is one or two descents: start(), then advance() while it
/// is_under_way(), turn_back(), advance() again, and finish().
///
/// Lanes without a learned choice need the first descent alone: from the root to a light. Those that the tree leads go from the root
/// to a cluster, and from there to a light. Those that the learned choice leads go from the cluster to a light; their second
/// descent is from the root to the cluster, for its probability by the tree.
class LightTreeLanes : GroupRows {
public:
    PL_INLINE LightTreeLanes() : GroupRows(0) {}

    PL_INLINE void start(const LightTreeRows& tree, const VertexGroup& receivers, const LearnedLightsGroup& learned,
                         std::uint32_t first) {
        static_cast<GroupRows&>(*this) = GroupRows(first);
        tree_ = &tree;
        from_ = vector(receivers.position);
        way_.u = row(receivers.light.rows[0]);
        rows_ = integers(learned.first);
        has_learned_ = rows_ != LearnedLightsGroup::kNone;
        by_learned_ = by_tree_ = by_trail_ = trail_ = LaneInt{};
        LaneInt begin{};
        if (Lanes::any(has_learned_)) begin = choose_cluster();
        descend_from(begin, LaneInt{} == 0);
        to_light_ = ~by_tree_;
    }

    /// The second descent.
    PL_INLINE void turn_back() {
        first_node_ = node_;
        first_probability_ = probability_;
        if (!Lanes::any(has_learned_)) return;
        const LaneInt light = select(by_tree_, LaneInt{}, light_at(node_));
        trail_ = place(light, offsetof(LightPlace, trail));
        by_trail_ = by_learned_;
        to_light_ = by_tree_;
        descend_from(select(by_learned_, LaneInt{}, node_), has_learned_);
    }

    PL_INLINE bool is_under_way() const { return Lanes::any(active_); }
    /// Goes one level down, in the lanes that have not arrived.
    PL_INLINE void advance() {
        const LaneInt parent = select(active_, node_, LaneInt{});
        const Words<LightNode> node(tree_->nodes, parent);
        const LaneInt next = node.integer(offsetof(LightNode, next));
        active_ &= ~select(to_light_, node.integer(offsetof(LightNode, is_leaf)) != 0,
                           node.integer(offsetof(LightNode, cluster)) != kNone);
        if (!is_under_way()) return;
        // The other lanes look at a child of the root, which exists.
        const LaneInt first = select(active_, parent, LaneInt{}) + 1;
        const LaneInt second = select(active_, next, first);
        const LaneFloat share = first_child_share(bounds_of(first), bounds_of(second), from_);
        WayByNumberOf<Lanes> way = way_;
        const LaneInt by_number = way.takes_second(share);
        way_.u = select(active_ & ~by_trail_, way.u, way_.u);
        const LaneInt is_second = select(by_trail_, (trail_ & 1) != 0, by_number);
        trail_ = std::bit_cast<LaneInt>(std::bit_cast<LaneUint>(trail_) >> 1);
        const LaneFloat reached = probability_ * select(is_second, 1.0f - share, share);
        probability_ = select(active_, reached, probability_);
        node_ = select(active_, select(is_second, second, first), node_);
    }

    PL_INLINE void finish(LightSampleGroup& samples) const {
        LaneInt leaf = first_node_;
        LaneFloat probability = first_probability_;
        if (Lanes::any(has_learned_)) {
            leaf = select(by_tree_, node_, first_node_);
            const LaneFloat within = select(by_tree_, probability_, first_probability_);
            const LaneFloat of_cluster = select(by_tree_, first_probability_, probability_);
            const LaneInt cluster = select(has_learned_, cluster_of(light_at(leaf)), LaneInt{});
            const LaneFloat mixed = mix_cluster_probability(of_cluster, learned_probability(cluster)) * within;
            probability = select(has_learned_, mixed, first_probability_);
        }
        const LaneInt light = light_at(leaf);
        store(light, samples.light);
        store(probability, samples.probability);
        store(probability * Lanes::from_bits(place(light, offsetof(LightPlace, pdf_area))), samples.pdf_area);
        store(cluster_of(light), samples.cluster);
    }

private:
    /// Decides which lanes the learned choice leads. Returns the roots of their clusters, and that of the tree for others.
    PL_INLINE LaneInt choose_cluster() {
        rows_ = select(has_learned_, rows_, LaneInt{});
        WayByNumberOf<Lanes> way = way_;
        by_learned_ = has_learned_ & way.takes_second(broadcast(kTreeShare));
        by_tree_ = has_learned_ & ~by_learned_;
        way_.u = select(has_learned_, way.u, way_.u);
        const int last = static_cast<int>(tree_->cluster_count) - 1;
        const LaneInt cluster = Lanes::count_not_above(tree_->learned, rows_, last, way_.u);
        way.enter(below(cluster), learned_probability(cluster));
        way_.u = select(by_learned_, way.u, way_.u);
        const LaneInt root = Words<std::uint32_t>(tree_->clusters, cluster).integer(0);
        return select(by_learned_, root, LaneInt{});
    }
    PL_INLINE void descend_from(const LaneInt& node, const LaneInt& lanes) {
        node_ = node;
        probability_ = broadcast(1.0f);
        active_ = lanes;
    }

    PL_INLINE LightBounds<Lanes> bounds_of(const LaneInt& number) const {
        const Words<LightNode> node(tree_->nodes, number);
        return {node.vector(offsetof(LightNode, center)), node.real(offsetof(LightNode, radius)),
                node.vector(offsetof(LightNode, axis)), node.real(offsetof(LightNode, cos_spread)),
                node.real(offsetof(LightNode, power))};
    }
    /// The light of a leaf. Of an inner node it is the number of another node.
    PL_INLINE LaneInt light_at(const LaneInt& leaf) const {
        return Words<LightNode>(tree_->nodes, leaf).integer(offsetof(LightNode, next));
    }
    PL_INLINE LaneInt place(const LaneInt& light, std::size_t offset) const {
        return Words<LightPlace>(tree_->of_light, light).integer(offset);
    }
    PL_INLINE LaneInt cluster_of(const LaneInt& light) const { return place(light, offsetof(LightPlace, cluster)); }

    /// See LearnedLights.
    PL_INLINE LaneFloat below(const LaneInt& cluster) const {
        const LaneInt is_first = cluster == 0;
        const LaneFloat before = Lanes::load(tree_->learned, rows_ + select(is_first, LaneInt{}, cluster - 1));
        return select(is_first, LaneFloat{}, before);
    }
    PL_INLINE LaneFloat learned_probability(const LaneInt& cluster) const {
        return Lanes::load(tree_->learned, rows_ + cluster) - below(cluster);
    }

    static constexpr auto kNone = static_cast<std::int32_t>(kNoCluster);
    static_assert(kMostLightClusters <= 32, "the root of a cluster has less than 32 levels above it");

    const LightTreeRows* tree_;
    Real3<Lanes> from_;
    WayByNumberOf<Lanes> way_;
    LaneInt rows_, has_learned_;
    LaneInt by_learned_, by_tree_;  ///< the lanes that either leads, of those with a learned choice
    LaneInt to_light_;              ///< lanes whose descent ends at a light, not at the root of a cluster
    LaneInt by_trail_, trail_;      ///< lanes that follow a trail, not their number; bits as in LightPlace
    LaneInt node_, active_;
    LaneFloat probability_;  ///< of reaching the node from where the descent began
    LaneInt first_node_;     ///< where the first descent ended
    LaneFloat first_probability_;
};

/// Vectors in turn: a level of one is a long chain of operations, and those of others overlap with it.
PL_INLINE void choose_by_tree_in_groups(const LightTreeRows& tree, const VertexGroup* receivers,
                                        const LearnedLightsGroup* learned, LightSampleGroup* samples,
                                        std::uint32_t groups) {
    constexpr std::uint32_t kVectors = kGroupSize / kLaneWidth;
    LightTreeLanes ways[kBlockGroups * kVectors];
    const auto for_all = [&](const auto& step) {
        for (std::uint32_t i = 0; i < groups * kVectors; ++i) step(ways[i], i / kVectors, i % kVectors * kLaneWidth);
    };
    const auto descend = [&] {
        bool is_on_the_way = true;
        while (is_on_the_way) {
            is_on_the_way = false;
            for_all([&](LightTreeLanes& way, std::uint32_t, std::uint32_t) {
                if (!way.is_under_way()) return;
                way.advance();
                is_on_the_way = true;
            });
        }
    };
    for_all([&](LightTreeLanes& way, std::uint32_t group, std::uint32_t first) {
        way.start(tree, receivers[group], learned[group], first);
    });
    descend();
    for_all([](LightTreeLanes& way, std::uint32_t, std::uint32_t) { way.turn_back(); });
    if (tree.learned != nullptr) descend();
    for_all([&](const LightTreeLanes& way, std::uint32_t group, std::uint32_t) { way.finish(samples[group]); });
}

}  // namespace
}  // namespace pl
