// Descents of a light tree for vectors of points: the choice of a light, and the density of one that was hit. Included by one file per
// instruction set; see lanes.h. Bit-identical to choose_light() and light_pdf_area().
#pragma once

#include "cpu/lanes/group_rows.h"

namespace pl {
namespace {

/// The ways to given lights, see LightPlace::trail.
struct LightTrailLanes {
    LaneUint low{}, high{};

    PL_INLINE LaneInt takes_second() {
        const LaneInt is_second = (low & 1u) != 0u;
        low = (low >> 1) | (high << 31);
        high >>= 1;
        return is_second;
    }
};

/// A vector of points on their way down the tree.
class LightDescentLanes : protected GroupRows {
public:
    PL_INLINE bool is_under_way() const { return Lanes::any(active_); }

protected:
    struct Children {
        LaneInt first, second;
        LaneFloat share;  ///< of the first
    };
    static constexpr auto kNoClusterLane = static_cast<std::int32_t>(kNoCluster);

    PL_INLINE LightDescentLanes() : GroupRows(0) {}

    PL_INLINE void set_points(const LightTreeRows& tree, const VectorGroup& from, const LearnedLightsGroup& learned,
                              std::uint32_t first) {
        static_cast<GroupRows&>(*this) = GroupRows(first);
        tree_ = &tree;
        from_ = vector(from);
        rows_ = integers(learned.first);
        has_learned_ = rows_ != LearnedLightsGroup::kNone;
        rows_ = select(has_learned_, rows_, LaneInt{});
    }
    PL_INLINE void descend_from(const LaneInt& node, const LaneInt& lanes) {
        node_ = node;
        probability_ = broadcast(1.0f);
        active_ = lanes;
    }
    /// The nodes of active lanes, of which next_ is read; the root for others.
    PL_INLINE LaneInt arrive() {
        const LaneInt node = select(active_, node_, LaneInt{});
        next_ = read(node, offsetof(LightNode, next));
        return node;
    }
    PL_INLINE LaneInt read(const LaneInt& node, std::size_t offset) const {
        return Words<LightNode>(tree_->nodes, node).integer(offset);
    }
    /// The light of a leaf. Of an inner node it is the number of another node.
    PL_INLINE LaneInt light_at(const LaneInt& leaf) const { return read(leaf, offsetof(LightNode, next)); }
    /// The children of the nodes of active lanes, which are not leaves. The other lanes look at a child of the root, which exists.
    PL_INLINE Children children() const {
        const LaneInt first = select(active_, node_, LaneInt{}) + 1;
        const LaneInt second = select(active_, next_, first);
        return {first, second, first_child_share(bounds_of(first), bounds_of(second), from_)};
    }
    PL_INLINE void enter(const Children& of, const LaneInt& is_second) {
        const LaneFloat reached = probability_ * select(is_second, 1.0f - of.share, of.share);
        probability_ = select(active_, reached, probability_);
        node_ = select(active_, select(is_second, of.second, of.first), node_);
    }

    PL_INLINE LaneInt place(const LaneInt& light, std::size_t offset) const {
        return Words<LightPlace>(tree_->of_light, light).integer(offset);
    }
    PL_INLINE LightTrailLanes trail_to(const LaneInt& light) const {
        constexpr std::size_t kTrail = offsetof(LightPlace, trail);
        return {std::bit_cast<LaneUint>(place(light, kTrail)), std::bit_cast<LaneUint>(place(light, kTrail + 4))};
    }
    PL_INLINE LaneInt cluster_of(const LaneInt& light) const { return place(light, offsetof(LightPlace, cluster)); }
    /// Probability of a light, times its density per unit area.
    PL_INLINE LaneFloat pdf_area(const LaneInt& light, const LaneFloat& probability) const {
        return probability * Lanes::from_bits(place(light, offsetof(LightPlace, pdf_area)));
    }

    /// See LearnedLights.
    PL_INLINE LaneFloat below(const LaneInt& cluster) const {
        const LaneInt is_first = cluster == 0;
        const LaneFloat before = Lanes::load(tree_->learned, rows_ + select(is_first, LaneInt{}, cluster - 1));
        return select(is_first, LaneFloat{}, before);
    }
    PL_INLINE LaneFloat learned_probability(const LaneInt& cluster) const {
        return Lanes::load(tree_->learned, rows_ + cluster) - below(cluster);
    }
    /// The probability of a light that is reached from the root of its cluster with the probability `within`.
    PL_INLINE LaneFloat mix(const LaneInt& light, const LaneFloat& of_cluster, const LaneFloat& within) const {
        const LaneInt cluster = select(has_learned_, cluster_of(light), LaneInt{});
        return mix_cluster_probability(of_cluster, learned_probability(cluster)) * within;
    }

    const LightTreeRows* tree_;
    LaneInt rows_, has_learned_;
    LaneInt node_, active_;
    LaneInt next_;           ///< LightNode::next of the nodes of active lanes
    LaneFloat probability_;  ///< of reaching the node from where the descent began

private:
    PL_INLINE LightBounds<Lanes> bounds_of(const LaneInt& number) const {
        const Words<LightNode> node(tree_->nodes, number);
        return {node.vector(offsetof(LightNode, center)), node.real(offsetof(LightNode, radius)),
                node.vector(offsetof(LightNode, axis)), node.real(offsetof(LightNode, cos_spread)),
                node.real(offsetof(LightNode, power))};
    }

    Real3<Lanes> from_;
};

/// A vector of receivers that choose lights. A choice is one or two descents: start(), then advance() while it is_under_way(),
/// turn_back(), advance() again, and finish().
///
/// Lanes without a learned choice need the first descent alone: from the root to a light. Lanes that the tree leads
/// go from the root to a cluster, and from there to a light. Lanes that the learned choice leads go from the cluster
/// to a light; their second descent is from the root to the cluster, for its probability by the tree.
class LightChoiceLanes : public LightDescentLanes {
public:
    PL_INLINE void start(const LightTreeRows& tree, const VertexGroup& receivers, const LearnedLightsGroup& learned,
                         std::uint32_t first) {
        set_points(tree, receivers.position, learned, first);
        way_.u = row(receivers.light.rows[0]);
        by_learned_ = by_tree_ = by_trail_ = LaneInt{};
        trail_ = LaneUint{};
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
        trail_ = std::bit_cast<LaneUint>(place(light, offsetof(LightPlace, trail)));
        by_trail_ = by_learned_;
        to_light_ = by_tree_;
        descend_from(select(by_learned_, LaneInt{}, node_), has_learned_);
    }

    /// Goes one level down, in the lanes that have not arrived.
    PL_INLINE void advance() {
        const LaneInt node = arrive();
        active_ &= ~select(to_light_, read(node, offsetof(LightNode, is_leaf)) != 0,
                           read(node, offsetof(LightNode, cluster)) != kNoClusterLane);
        if (!is_under_way()) return;
        const Children of = children();
        WayByNumberOf<Lanes> way = way_;
        const LaneInt by_number = way.takes_second(of.share);
        way_.u = select(active_ & ~by_trail_, way.u, way_.u);
        enter(of, select(by_trail_, (trail_ & 1u) != 0u, by_number));
        trail_ >>= 1;
    }

    PL_INLINE void finish(LightSampleGroup& samples) const {
        const LaneInt light = light_at(select(by_tree_, node_, first_node_));
        LaneFloat probability = first_probability_;
        if (Lanes::any(has_learned_)) {
            const LaneFloat mixed = mix(light, select(by_tree_, first_probability_, probability_),
                                        select(by_tree_, probability_, first_probability_));
            probability = select(has_learned_, mixed, first_probability_);
        }
        store(light, samples.light);
        store(pdf_area(light, probability), samples.pdf_area);
        store(cluster_of(light), samples.cluster);
    }

private:
    /// Decides which lanes the learned choice leads. Returns the roots of their clusters, and the root of the tree
    /// for other lanes.
    PL_INLINE LaneInt choose_cluster() {
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

    WayByNumberOf<Lanes> way_;
    LaneInt by_learned_, by_tree_;  ///< the lanes that either leads, of those with a learned choice
    LaneInt to_light_;              ///< lanes whose descent ends at a light, not at the root of a cluster
    static_assert(kMostLightClusters <= 32, "the root of a cluster has less than 32 levels above it");
    LaneInt by_trail_;    ///< lanes that follow a trail, not their number
    LaneUint trail_;      ///< the levels above the cluster of LightPlace::trail
    LaneInt first_node_;  ///< where the first descent ended
    LaneFloat first_probability_;
};

/// A vector of points whose paths have hit lights: the density of light sampling there. start(), advance() while it is_under_way(),
/// finish().
class LightDensityLanes : public LightDescentLanes {
public:
    PL_INLINE void start(const LightTreeRows& tree, const LightHitGroup& hits, std::uint32_t first) {
        set_points(tree, hits.from, hits.learned, first);
        trail_ = trail_to(integers(hits.light));
        of_cluster_ = broadcast(1.0f);
        descend_from(LaneInt{}, LaneInt{} == 0);
    }
    PL_INLINE void advance() {
        // The probability by the tree ends at the root of the cluster, where another begins.
        const LaneInt node = arrive();
        const LaneInt ends = active_ & has_learned_ & (read(node, offsetof(LightNode, cluster)) != kNoClusterLane);
        of_cluster_ = select(ends, probability_, of_cluster_);
        probability_ = select(ends, broadcast(1.0f), probability_);
        active_ &= read(node, offsetof(LightNode, is_leaf)) == 0;
        if (is_under_way()) enter(children(), trail_.takes_second());
    }
    PL_INLINE void finish(LightHitGroup& hits) const {
        const LaneInt light = integers(hits.light);
        LaneFloat probability = probability_;
        if (Lanes::any(has_learned_))
            probability = select(has_learned_, mix(light, of_cluster_, probability_), probability_);
        store(pdf_area(light, probability), hits.pdf_area);
    }

private:
    LightTrailLanes trail_;
    LaneFloat of_cluster_;  ///< probability of reaching the cluster of the light
};

/// Vectors of up to kBlockGroups groups in turn: a level of one vector is a long chain of operations, which the
/// operations of other vectors overlap.
template <class Descent>
class DescentsInTurn {
public:
    explicit PL_INLINE DescentsInTurn(std::uint32_t groups) : count_(groups * kVectors) {}

    /// Calls step(descent, group, first lane).
    PL_INLINE void for_all(const auto& step) {
        for (std::uint32_t i = 0; i < count_; ++i) step(descents_[i], i / kVectors, i % kVectors * kLaneWidth);
    }
    PL_INLINE void descend() {
        bool is_under_way = true;
        while (is_under_way) {
            is_under_way = false;
            for_all([&](Descent& descent, std::uint32_t, std::uint32_t) {
                if (!descent.is_under_way()) return;
                descent.advance();
                is_under_way = true;
            });
        }
    }

private:
    static constexpr std::uint32_t kVectors = kGroupSize / kLaneWidth;

    std::uint32_t count_;
    Descent descents_[kBlockGroups * kVectors];
};

void choose_by_tree(const LightTreeRows& tree, const VertexGroup* receivers, const LearnedLightsGroup* learned,
                    LightSampleGroup* samples, std::uint32_t groups) {
    DescentsInTurn<LightChoiceLanes> choices(groups);
    choices.for_all([&](LightChoiceLanes& choice, std::uint32_t group, std::uint32_t first) {
        choice.start(tree, receivers[group], learned[group], first);
    });
    choices.descend();
    choices.for_all([](LightChoiceLanes& choice, std::uint32_t, std::uint32_t) { choice.turn_back(); });
    if (tree.learned != nullptr) choices.descend();
    choices.for_all(
        [&](const LightChoiceLanes& choice, std::uint32_t group, std::uint32_t) { choice.finish(samples[group]); });
}

void find_light_densities(const LightTreeRows& tree, LightHitGroup* hits, std::uint32_t groups) {
    for (std::uint32_t begin = 0; begin < groups; begin += kBlockGroups) {
        DescentsInTurn<LightDensityLanes> densities(groups - begin < kBlockGroups ? groups - begin : kBlockGroups);
        densities.for_all([&](LightDensityLanes& density, std::uint32_t group, std::uint32_t first) {
            density.start(tree, hits[begin + group], first);
        });
        densities.descend();
        densities.for_all([&](const LightDensityLanes& density, std::uint32_t group, std::uint32_t) {
            density.finish(hits[begin + group]);
        });
    }
}

}  // namespace
}  // namespace pl
