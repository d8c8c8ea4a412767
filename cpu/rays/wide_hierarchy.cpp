#include "cpu/rays/wide_hierarchy.h"

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
    std::uint32_t triangles;
};

/// The cheapest way to divide up to `most` children between both halves of a subtree.
struct ChildSplit {
    float cost;
    std::uint32_t left;  ///< children that the left half gets
};
ChildSplit cheapest_split(const SubtreeCosts& left, const SubtreeCosts& right, std::uint32_t most) {
    ChildSplit best{std::numeric_limits<float>::infinity(), 1};
    for (std::uint32_t i = 1; i < most; ++i) {
        const float cost = left.as[i] + right.as[most - i];
        if (cost < best.cost) best = {cost, i};
    }
    return best;
}

/// The decisions about a subtree, which outlive its costs and take a tenth of their memory.
class SubtreeChoice {
public:
    /// Children that the left half gets of `most`, 2 to kWideChildren; 0: as with one less.
    std::uint32_t left_of(std::uint32_t most) const { return (bits_ >> shift_of(most)) & kMask; }
    void set_left(std::uint32_t most, std::uint32_t left) { bits_ |= left << shift_of(most); }
    bool is_leaf() const { return (bits_ & kLeaf) != 0; }
    void set_leaf() { bits_ |= kLeaf; }

private:
    static constexpr std::uint32_t kBits = 3;
    static constexpr std::uint32_t kMask = (1u << kBits) - 1u;
    static constexpr std::uint32_t kLeaf = 1u << 31;
    static_assert(kWideChildren - 1 <= kMask && kBits * (kWideChildren - 1) < 31);

    static std::uint32_t shift_of(std::uint32_t most) { return kBits * (most - 2); }

    std::uint32_t bits_ = 0;
};

class Widener {
public:
    Widener(Span<const BvhNode> narrow, std::uint32_t most) : narrow_(narrow), most_(most), choices_(narrow.count) {}

    std::vector<WideNode> make(std::span<const std::uint32_t> roots) {
        nodes_.resize(roots.size());
        for (std::uint32_t i = 0; i < roots.size(); ++i) {
            find_costs(roots[i]);
            make_below(i, roots[i]);
        }
        return std::move(nodes_);
    }

private:
    /// Recursive: no hierarchy is deeper than kMaxBvhDepth.
    SubtreeCosts find_costs(std::uint32_t index) {
        const BvhNode& node = narrow_[index];
        SubtreeChoice& choice = choices_[index];
        if (node.count > 0) {
            SubtreeCosts costs{.as = {}, .triangles = node.count};
            costs.as.fill(leaf_cost(node, node.count));
            choice.set_leaf();
            return costs;
        }
        const SubtreeCosts left = find_costs(node.first);
        const SubtreeCosts right = find_costs(node.first + 1);
        const ChildSplit all = cheapest_split(left, right, kWideChildren);
        choice.set_left(kWideChildren, all.left);
        SubtreeCosts costs{.as = {}, .triangles = left.triangles + right.triangles};
        const float inner = all.cost + kNodeCost * half_area(node);
        const float leaf = leaf_cost(node, costs.triangles);
        if (costs.triangles <= most_ && leaf <= inner) choice.set_leaf();  // areas may overflow: both are infinite
        costs.as[1] = std::min(leaf, inner);
        for (std::uint32_t i = 2; i < kWideChildren; ++i) {
            const ChildSplit split = cheapest_split(left, right, i);
            costs.as[i] = std::min(costs.as[i - 1], split.cost);
            if (split.cost < costs.as[i - 1]) choice.set_left(i, split.left);
        }
        return costs;
    }
    float leaf_cost(const BvhNode& node, std::uint32_t triangles) const {
        if (triangles > most_) return std::numeric_limits<float>::infinity();
        return half_area(node) * (kLeafCost + kTriangleCost * static_cast<float>(triangles));
    }

    /// Fills a node, which is there, and appends the nodes below it.
    void make_below(std::uint32_t root, std::uint32_t narrow_root) {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> tasks{{root, narrow_root}};
        while (!tasks.empty()) {
            const auto [wide, narrow] = tasks.back();
            tasks.pop_back();
            children_.clear();
            if (choices_[narrow].is_leaf())
                children_.push_back(narrow);
            else
                split(narrow, kWideChildren);
            fill(wide, tasks);
        }
    }

    /// Appends the roots of the cheapest cut of a subtree into `most` children, from left to right.
    void split(std::uint32_t node, std::uint32_t most) {
        const std::uint32_t left = choices_[node].left_of(most);
        const std::uint32_t child = narrow_[node].first;
        append(child, left);
        append(child + 1, most - left);
    }
    void append(std::uint32_t node, std::uint32_t most) {
        while (most > 1 && choices_[node].left_of(most) == 0) --most;
        if (most == 1)
            children_.push_back(node);
        else
            split(node, most);
    }

    /// The triangles below a node, which are neighbors.
    WideReference leaf_of(std::uint32_t node) const {
        std::uint32_t leftmost = node;
        while (narrow_[leftmost].count == 0) leftmost = narrow_[leftmost].first;
        return {(narrow_[leftmost].first << WideReference::kCountBits) | triangles_below(node)};
    }
    std::uint32_t triangles_below(std::uint32_t node) const {
        const BvhNode& at = narrow_[node];
        return at.count > 0 ? at.count : triangles_below(at.first) + triangles_below(at.first + 1);
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
            if (choices_[children_[i]].is_leaf()) {
                node.children[i] = leaf_of(children_[i]);
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
    std::vector<SubtreeChoice> choices_;
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
