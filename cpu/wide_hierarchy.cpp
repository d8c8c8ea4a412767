#include "cpu/wide_hierarchy.h"

#include <algorithm>
#include <array>
#include <limits>

namespace pl {
namespace {

/// Costs of visiting a node and a leaf, and of each triangle of a leaf.
constexpr float kNodeCost = 1.0f;
constexpr float kLeafCost = 0.6f;
constexpr float kTriangleCost = 0.1f;

float half_area(const BvhNode& node) {
    const Vec3f d = node.high - node.low;
    return d.x * d.y + d.y * d.z + d.z * d.x;
}

/// The least costs of a subtree of the two-wide hierarchy, as 1 to 7 children of a wide node.
struct SubtreeCosts {
    std::array<float, kWideChildren> as;  ///< [i]: as at most i children; [0] is unused
    std::uint32_t first;                  ///< of its triangles
    std::uint32_t count;
    bool is_leaf;
};

class Widener {
public:
    Widener(Span<const BvhNode> narrow, std::uint32_t most) : narrow_(narrow), most_(most), costs_(narrow.count) {}

    std::vector<WideNode> make(std::span<const std::uint32_t> roots) {
        // Children have higher numbers than their parents.
        for (std::uint32_t i = narrow_.count; i-- > 0;) find_costs(i);
        nodes_.resize(roots.size());
        for (std::uint32_t i = 0; i < roots.size(); ++i) make_below(i, roots[i]);
        return std::move(nodes_);
    }

private:
    /// The least cost of the two children of a node as `most` children, at most kWideChildren, and how many of them the
    /// left one gets.
    std::pair<float, std::uint32_t> cheapest_split(std::uint32_t node, std::uint32_t most) const {
        const std::uint32_t left = narrow_[node].first;
        std::pair<float, std::uint32_t> best{std::numeric_limits<float>::infinity(), 1};
        for (std::uint32_t i = 1; i < most; ++i) {
            const float cost = costs_[left].as[i] + costs_[left + 1].as[most - i];
            if (cost < best.first) best = {cost, i};
        }
        return best;
    }

    void find_costs(std::uint32_t index) {
        const BvhNode& node = narrow_[index];
        SubtreeCosts& costs = costs_[index];
        const float area = half_area(node);
        float inner = std::numeric_limits<float>::infinity();
        if (node.count > 0) {
            costs.first = node.first;
            costs.count = node.count;
        } else {
            costs.first = costs_[node.first].first;
            costs.count = costs_[node.first].count + costs_[node.first + 1].count;
            inner = cheapest_split(index, kWideChildren).first + kNodeCost * area;
        }
        const float leaf = costs.count <= most_ ? area * (kLeafCost + kTriangleCost * static_cast<float>(costs.count))
                                                : std::numeric_limits<float>::infinity();
        costs.is_leaf = leaf <= inner;
        costs.as[1] = std::min(leaf, inner);
        for (std::uint32_t i = 2; i < kWideChildren; ++i)
            costs.as[i] = node.count > 0 ? costs.as[1] : std::min(costs.as[i - 1], cheapest_split(index, i).first);
    }

    /// Fills a node, which is there, and appends those below it.
    void make_below(std::uint32_t root, std::uint32_t narrow_root) {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> tasks{{root, narrow_root}};
        while (!tasks.empty()) {
            const auto [wide, narrow] = tasks.back();
            tasks.pop_back();
            children_.clear();
            if (costs_[narrow].is_leaf)
                children_.push_back(narrow);
            else
                split(narrow, kWideChildren);
            fill(wide, tasks);
        }
    }

    /// Appends the roots of the cheapest cut of a subtree into at most `most` children, from left to right.
    void split(std::uint32_t node, std::uint32_t most) {
        const auto [cost, left] = cheapest_split(node, most);
        const std::uint32_t child = narrow_[node].first;
        append(child, left);
        append(child + 1, most - left);
    }
    void append(std::uint32_t node, std::uint32_t most) {
        while (most > 1 && costs_[node].as[most] == costs_[node].as[most - 1]) --most;
        if (most == 1)
            children_.push_back(node);
        else
            split(node, most);
    }

    void fill(std::uint32_t wide, std::vector<std::pair<std::uint32_t, std::uint32_t>>& tasks) {
        const auto count = static_cast<std::uint32_t>(children_.size());
        WideNode node{};
        node.child_bits = (1u << count) - 1u;
        const std::size_t waiting = tasks.size();
        for (std::uint32_t i = 0; i < count; ++i) {
            const BvhNode& child = narrow_[children_[i]];
            for (int axis = 0; axis < 3; ++axis) {
                node.planes[axis][0][i] = child.low[axis];
                node.planes[axis][1][i] = child.high[axis];
            }
            const SubtreeCosts& costs = costs_[children_[i]];
            if (costs.is_leaf) {
                node.children[i] = {(costs.first << WideReference::kCountBits) | costs.count};
            } else {
                const auto place = static_cast<std::uint32_t>(nodes_.size());
                node.children[i] = {place << WideReference::kCountBits};
                nodes_.emplace_back();
                tasks.emplace_back(place, children_[i]);
            }
        }
        std::reverse(tasks.begin() + static_cast<std::ptrdiff_t>(waiting), tasks.end());
        nodes_[wide] = node;
    }

    Span<const BvhNode> narrow_;
    std::uint32_t most_;  ///< triangles of a leaf
    std::vector<SubtreeCosts> costs_;
    std::vector<WideNode> nodes_;
    std::vector<std::uint32_t> children_;  ///< of the node that is being filled, in the two-wide hierarchy
};

LeafBlock block_of(const BvhTriangle* first, std::uint32_t count) {
    LeafBlock block;
    for (std::uint32_t i = 0; i < kWideChildren; ++i) {
        const BvhTriangle& triangle = first[std::min(i, count - 1)];
        const Vec3f corners[3] = {triangle.p0, triangle.p1, triangle.p2};
        for (int corner = 0; corner < 3; ++corner)
            for (int axis = 0; axis < 3; ++axis) block.corners[corner][axis][i] = corners[corner][axis];
        block.primitives[i] = triangle.primitive;
    }
    return block;
}

}  // namespace

std::vector<WideNode> make_wide_nodes(const BvhView& bvh) {
    constexpr std::uint32_t kRoot = 0;
    if (bvh.nodes.empty()) return {};
    return make_wide_nodes(bvh.nodes, {&kRoot, 1});
}

std::vector<WideNode> make_wide_nodes(Span<const BvhNode> narrow, std::span<const std::uint32_t> roots,
                                      std::uint32_t most) {
    return Widener(narrow, most).make(roots);
}

std::vector<LeafBlock> make_leaf_blocks(std::span<WideNode> nodes, Span<const BvhTriangle> triangles) {
    std::vector<LeafBlock> blocks;
    for (WideNode& node : nodes)
        for (std::uint32_t i = 0; i < kWideChildren; ++i) {
            WideReference& child = node.children[i];
            if (((node.child_bits >> i) & 1u) == 0 || child.count() == 0) continue;
            const auto number = static_cast<std::uint32_t>(blocks.size());
            blocks.push_back(block_of(&triangles[child.first()], child.count()));
            child = {(number << WideReference::kCountBits) | child.count()};
        }
    return blocks;
}

}  // namespace pl
