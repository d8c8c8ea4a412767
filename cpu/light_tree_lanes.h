// The choice of lights by a light tree for a vector of receivers. Included by one file per instruction set; see lanes.h. Bit-identical to
// choose_light().
#pragma once

#include "cpu/group_rows.h"

namespace pl {
namespace {

class LightTreeLanes : GroupRows {
public:
    PL_INLINE LightTreeLanes(const LightTreeRows& tree, const VertexGroup& receivers, std::uint32_t first)
        : GroupRows(first), tree_(tree), from_(vector(receivers.position)), way_{row(receivers.light.rows[0])} {}

    PL_INLINE void choose(const LearnedLightsGroup& learned, LightSampleGroup& samples) {
        const LaneInt all = LaneInt{} == 0;
        const LaneInt rows = integers(learned.first);
        const LaneInt has_learned = rows != LearnedLightsGroup::kNone;
        if (!Lanes::any(has_learned)) {
            const Descent leaf = descend(LaneInt{}, Ends{all, LaneInt{}, LaneInt{}}, all);
            return finish(leaf.node, leaf.probability, samples);
        }
        choose_learned(has_learned, select(has_learned, rows, LaneInt{}), samples);
    }

private:
    /// A node, and the probability of reaching it; see LightDescent.
    struct Descent {
        LaneInt node;
        LaneFloat probability;
    };
    /// Where a descent ends, and how it gets there.
    struct Ends {
        LaneInt to_light;  ///< lanes that end at a light, not at the root of a cluster
        LaneInt by_trail;  ///< lanes that follow a trail, not their number
        LaneInt trail;     ///< bits as in LightPlace; the root of a cluster has less than 32 levels above it
    };
    static_assert(kMostLightClusters <= 32);

    /// Two descents for all lanes. Lanes without a learned choice need the first alone: from the root to a light. Those that the tree
    /// leads go from the root to a cluster, and from there to a light. Those that the learned choice leads go from the cluster
    /// to a light; the second descent is then the tree's probability of that cluster.
    PL_INLINE void choose_learned(const LaneInt& has_learned, const LaneInt& rows, LightSampleGroup& samples) {
        WayByNumberOf<Lanes> way = way_;
        const LaneInt by_learned = has_learned & way.takes_second(broadcast(kTreeShare));
        way_.u = select(has_learned, way.u, way_.u);
        const LaneInt by_tree = has_learned & ~by_learned;
        const LaneInt drawn = Lanes::count_not_above(tree_.learned, rows, last_cluster(), way_.u);
        way.enter(below(rows, drawn), learned_probability(rows, drawn));
        way_.u = select(by_learned, way.u, way_.u);

        const LaneInt begin = select(by_learned, cluster_root(drawn), LaneInt{});
        const LaneInt all = LaneInt{} == 0;
        const Descent first = descend(begin, Ends{~by_tree, LaneInt{}, LaneInt{}}, all);
        const LaneInt light = select(by_tree, LaneInt{}, light_at(first.node));
        const LaneInt trail = place(light, offsetof(LightPlace, trail));
        const Descent second =
            descend(select(by_learned, LaneInt{}, first.node), Ends{by_tree, by_learned, trail}, has_learned);

        const LaneInt leaf = select(by_tree, second.node, first.node);
        const LaneFloat within = select(by_tree, second.probability, first.probability);
        const LaneFloat of_cluster = select(by_tree, first.probability, second.probability);
        const LaneInt cluster = select(has_learned, cluster_of(light_at(leaf)), LaneInt{});
        const LaneFloat mixed = mix_cluster_probability(of_cluster, learned_probability(rows, cluster)) * within;
        finish(leaf, select(has_learned, mixed, first.probability), samples);
    }

    PL_INLINE Descent descend(const LaneInt& begin, Ends ends, LaneInt active) {
        Descent at{begin, broadcast(1.0f)};
        for (;;) {
            const LaneInt parent = select(active, at.node, LaneInt{});
            const Words<LightNode> node(tree_.nodes, parent);
            const LaneInt is_leaf = node.integer(offsetof(LightNode, is_leaf)) != 0;
            const LaneInt is_cluster = node.integer(offsetof(LightNode, cluster)) != kNone;
            active &= ~select(ends.to_light, is_leaf, is_cluster);
            if (!Lanes::any(active)) return at;
            // The other lanes stay at inner nodes of the first levels, so that their children exist.
            const LaneInt inner = select(active, parent, LaneInt{});
            const LaneInt first = inner + 1;
            const LaneInt second = Words<LightNode>(tree_.nodes, inner).integer(offsetof(LightNode, next));
            const LaneFloat share = first_child_share(bounds_of(first), bounds_of(second), from_);
            WayByNumberOf<Lanes> way = way_;
            const LaneInt by_number = way.takes_second(share);
            way_.u = select(active & ~ends.by_trail, way.u, way_.u);
            const LaneInt is_second = select(ends.by_trail, (ends.trail & 1) != 0, by_number);
            ends.trail = std::bit_cast<LaneInt>(std::bit_cast<LaneUint>(ends.trail) >> 1);
            const LaneFloat reached = at.probability * select(is_second, 1.0f - share, share);
            at.probability = select(active, reached, at.probability);
            at.node = select(active, select(is_second, second, first), at.node);
        }
    }

    PL_INLINE LightBounds<Lanes> bounds_of(const LaneInt& number) const {
        const Words<LightNode> node(tree_.nodes, number);
        return {node.vector(offsetof(LightNode, center)), node.real(offsetof(LightNode, radius)),
                node.vector(offsetof(LightNode, axis)), node.real(offsetof(LightNode, cos_spread)),
                node.real(offsetof(LightNode, power))};
    }
    /// The light of a leaf. Of an inner node it is the number of another node.
    PL_INLINE LaneInt light_at(const LaneInt& leaf) const {
        return Words<LightNode>(tree_.nodes, leaf).integer(offsetof(LightNode, next));
    }
    PL_INLINE LaneInt place(const LaneInt& light, std::size_t offset) const {
        return Words<LightPlace>(tree_.of_light, light).integer(offset);
    }
    PL_INLINE LaneInt cluster_of(const LaneInt& light) const { return place(light, offsetof(LightPlace, cluster)); }
    PL_INLINE LaneInt cluster_root(const LaneInt& cluster) const {
        return Words<std::uint32_t>(tree_.clusters, cluster).integer(0);
    }

    PL_INLINE int last_cluster() const { return static_cast<int>(tree_.cluster_count) - 1; }
    /// See LearnedLights.
    PL_INLINE LaneFloat below(const LaneInt& rows, const LaneInt& cluster) const {
        const LaneInt is_first = cluster == 0;
        const LaneFloat before = Lanes::load(tree_.learned, rows + select(is_first, LaneInt{}, cluster - 1));
        return select(is_first, LaneFloat{}, before);
    }
    PL_INLINE LaneFloat learned_probability(const LaneInt& rows, const LaneInt& cluster) const {
        return Lanes::load(tree_.learned, rows + cluster) - below(rows, cluster);
    }

    PL_INLINE void finish(const LaneInt& leaf, const LaneFloat& probability, LightSampleGroup& samples) const {
        const LaneInt light = light_at(leaf);
        store(light, samples.light);
        store(probability, samples.probability);
        store(probability * Lanes::from_bits(place(light, offsetof(LightPlace, pdf_area))), samples.pdf_area);
        store(cluster_of(light), samples.cluster);
    }

    static constexpr auto kNone = static_cast<std::int32_t>(kNoCluster);

    const LightTreeRows& tree_;
    Real3<Lanes> from_;
    WayByNumberOf<Lanes> way_;
};

PL_INLINE void choose_by_tree_in_groups(const LightTreeRows& tree, const VertexGroup* receivers,
                                        const LearnedLightsGroup* learned, LightSampleGroup* samples,
                                        std::uint32_t groups) {
    for (std::uint32_t group = 0; group < groups; ++group)
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
            LightTreeLanes(tree, receivers[group], first).choose(learned[group], samples[group]);
}

}  // namespace
}  // namespace pl
