#include "core/scene/reinsert_bvh.h"

#include <algorithm>
#include <queue>
#include <utility>

#include "core/scene/bvh_split.h"

namespace pl {
namespace {

/// Nodes that are tried in each round: the upper levels, which have most of the area. More of them bring less than 1 % of the cost on rooms of the
/// literature, and this number bounds the time on scenes of any size.
constexpr std::size_t kTried = 4096;
/// Rounds end when one gains less than this part of the first, and at the latest after kMostRounds.
constexpr double kLeastGain = 0.02;
constexpr int kMostRounds = 8;

double half_area(const BvhNode& node) { return pl::half_area(Vec3d{node.high} - Vec3d{node.low}); }

/// `a` with its box enlarged by the box of `b`.
BvhNode joined(BvhNode a, const BvhNode& b) {
    a.low = glm::min(a.low, b.low);
    a.high = glm::max(a.high, b.high);
    return a;
}

/// Nodes in pairs of children behind the root. Removing a node gives its parent's place to its sibling and leaves a free pair; inserting
/// it beside another node moves both to the free pair, below a new inner node in the other's place.
class Reinsertion {
public:
    explicit Reinsertion(std::vector<BvhNode>& nodes)
        : nodes_(nodes), parents_(nodes.size() / 2), heights_(nodes.size(), 0) {
        for (auto i = static_cast<std::uint32_t>(nodes.size()); i-- > 0;)
            if (nodes[i].count == 0) adopt_children(i);
    }

    /// The sum of the areas of all nodes falls by what is returned.
    double run_round(const std::vector<std::uint32_t>& tried) {
        double gain = 0.0;
        for (const std::uint32_t node : tried) {
            const Place best = find_place(node);
            if (best.gain <= 0.0 || exceeds_depth(node, best.sibling)) continue;
            move(node, best.sibling);
            gain += best.gain;
        }
        return gain;
    }

private:
    struct Place {
        std::uint32_t sibling = 0;
        double gain = 0.0;
    };
    /// A node beside which, or below which, there may be a better place.
    struct Waiting {
        double saved;  ///< by the removal, less what ancestors of the node would grow
        std::uint32_t node;
    };

    static std::uint32_t sibling_of(std::uint32_t node) { return ((node - 1) ^ 1u) + 1; }
    std::uint32_t parent_of(std::uint32_t node) const { return parents_[(node - 1) / 2]; }

    /// Goes up from the node, and down into the other subtree of each ancestor as far as a place there may still be better.
    Place find_place(std::uint32_t moved) {
        const BvhNode& node = nodes_[moved];
        const double own = half_area(node);
        Place best;
        std::uint32_t ancestor = parent_of(moved);
        double saved = half_area(nodes_[ancestor]);
        BvhNode rest = nodes_[sibling_of(moved)];  // what is left below the ancestor
        find_below(sibling_of(moved), saved, node, own, best);
        while (ancestor != 0) {
            const std::uint32_t other = sibling_of(ancestor);
            ancestor = parent_of(ancestor);
            find_below(other, saved, node, own, best);
            rest = joined(rest, nodes_[other]);
            saved += half_area(nodes_[ancestor]) - half_area(rest);
        }
        return best;
    }

    void find_below(std::uint32_t root, double saved_there, const BvhNode& node, double own, Place& best) {
        waiting_.push_back({saved_there, root});
        while (!waiting_.empty()) {
            const auto [saved, at] = waiting_.back();
            waiting_.pop_back();
            if (!(saved - own > best.gain)) continue;
            const double gain = saved - half_area(joined(nodes_[at], node));
            if (gain > best.gain) best = {at, gain};
            if (nodes_[at].count > 0) continue;
            const double saved_below = gain + half_area(nodes_[at]);
            waiting_.push_back({saved_below, nodes_[at].first});
            waiting_.push_back({saved_below, nodes_[at].first + 1});
        }
    }

    bool exceeds_depth(std::uint32_t moved, std::uint32_t sibling) const {
        int depth = 1;
        for (std::uint32_t at = sibling; at != 0; at = parent_of(at)) ++depth;
        return depth + std::max(heights_[moved], heights_[sibling]) >= kMaxBvhDepth - 1;
    }

    void move(std::uint32_t moved, std::uint32_t to) {
        const std::uint32_t parent = parent_of(moved);
        const std::uint32_t pair = nodes_[parent].first;
        const std::pair node{nodes_[moved], heights_[moved]};
        put({nodes_[sibling_of(moved)], heights_[sibling_of(moved)]}, parent);
        refit_above(parent);
        put({nodes_[to], heights_[to]}, pair);
        put(node, pair + 1);
        nodes_[to].first = pair;
        nodes_[to].count = 0;
        fit(to);
        refit_above(to);
    }
    void put(const std::pair<BvhNode, std::uint8_t>& node, std::uint32_t place) {
        nodes_[place] = node.first;
        heights_[place] = node.second;
        if (node.first.count == 0) parents_[(node.first.first - 1) / 2] = place;
    }
    void refit_above(std::uint32_t node) {
        while (node != 0) fit(node = parent_of(node));
    }
    /// The box of both children. Zeros of either sign are equal here, as they are for the tests of boxes.
    void fit(std::uint32_t inner) {
        BvhNode& node = nodes_[inner];
        node.low = glm::min(nodes_[node.first].low, nodes_[node.first + 1].low);
        node.high = glm::max(nodes_[node.first].high, nodes_[node.first + 1].high);
        adopt_children(inner);
    }
    void adopt_children(std::uint32_t inner) {
        const std::uint32_t first = nodes_[inner].first;
        parents_[(first - 1) / 2] = inner;
        heights_[inner] = static_cast<std::uint8_t>(1 + std::max(heights_[first], heights_[first + 1]));
    }

    std::vector<BvhNode>& nodes_;
    std::vector<std::uint32_t> parents_;  ///< of each pair
    std::vector<std::uint8_t> heights_;   ///< of the subtree below each node
    std::vector<Waiting> waiting_;
};

/// The nodes of largest area but the root, since boxes lie in the boxes of their parents.
std::vector<std::uint32_t> largest_nodes(const std::vector<BvhNode>& nodes) {
    std::vector<std::uint32_t> largest;
    std::priority_queue<std::pair<double, std::uint32_t>> waiting;
    const auto expand = [&](std::uint32_t inner) {
        for (const std::uint32_t child : {nodes[inner].first, nodes[inner].first + 1})
            waiting.emplace(half_area(nodes[child]), child);
    };
    expand(0);
    while (!waiting.empty() && largest.size() < kTried) {
        largest.push_back(waiting.top().second);
        waiting.pop();
        if (nodes[largest.back()].count == 0) expand(largest.back());
    }
    return largest;
}

Bvh depth_first(const Bvh& bvh) {
    Bvh ordered;
    ordered.nodes.reserve(bvh.nodes.size());
    ordered.primitives.reserve(bvh.primitives.size());
    ordered.nodes.emplace_back();
    std::vector<std::pair<std::uint32_t, std::uint32_t>> waiting{{0, 0}};
    while (!waiting.empty()) {
        const auto [from, to] = waiting.back();
        waiting.pop_back();
        BvhNode node = bvh.nodes[from];
        const std::uint32_t first = node.first;
        if (node.count > 0) {
            node.first = static_cast<std::uint32_t>(ordered.primitives.size());
            const auto begin = bvh.primitives.begin() + first;
            ordered.primitives.insert(ordered.primitives.end(), begin, begin + node.count);
        } else {
            node.first = static_cast<std::uint32_t>(ordered.nodes.size());
            ordered.nodes.resize(ordered.nodes.size() + 2);
            waiting.emplace_back(first + 1, node.first + 1);
            waiting.emplace_back(first, node.first);
        }
        ordered.nodes[to] = node;
    }
    return ordered;
}

}  // namespace

void reinsert_nodes(Bvh& bvh) {
    if (bvh.nodes.size() < 2) return;
    const std::vector<std::uint32_t> tried = largest_nodes(bvh.nodes);
    Reinsertion reinsertion(bvh.nodes);
    double first_gain = 0.0;
    for (int round = 0; round < kMostRounds; ++round) {
        const double gain = reinsertion.run_round(tried);
        if (round == 0) first_gain = gain;
        if (!(gain > kLeastGain * first_gain)) break;
    }
    if (first_gain > 0.0) bvh = depth_first(bvh);
}

}  // namespace pl
