// The update of an SD-tree: pending sums become learned radiance, and both kinds of trees are built anew from it.
// [Mueller et al. 2017, section 3]
#include "core/fields/sd_tree_model.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/parallel.h"
#include "core/fields/volume_irradiance_update.h"

namespace pl {
namespace {

constexpr std::uint32_t kLeafChunk = 16;
constexpr std::uint32_t kVolumeChunk = 256;
constexpr std::uint32_t kNone = 0xffffffffu;

/// Nodes for each leaf at least within the bound on all nodes, before leaves become fewer.
constexpr std::uint32_t kNodesPerLeaf = 16;

struct QuadNode {
    float energy[4];
    std::uint32_t child[4];
};
using Quadtree = std::vector<QuadNode>;

/// Moves the energies of a leaf, of nodes [first, end), towards the energies of its new samples; quadrants with
/// children get their sums.
void absorb_leaf(const FieldShape& shape, HostSdTree& tree, std::uint32_t leaf, std::uint32_t first,
                 std::uint32_t end) {
    const std::uint32_t fresh = tree.pending_count[leaf];
    const std::uint32_t visits = tree.visits[leaf];
    const float step = fresh > 0 ? learning_step(visits, fresh, shape.rate) : 0.0f;
    for (std::uint32_t node = end; node-- > first;)
        for (std::uint32_t slot = 4 * node; slot < 4 * node + 4; ++slot) {
            float& energy = tree.energy[slot];
            if (tree.child[slot] != 0)
                energy = sum_of_quadrants(&tree.energy[4 * (first + tree.child[slot])]);
            else if (fresh > 0)
                energy = moved(energy, from_fixed_point(tree.pending_energy[slot], fresh, shape.radiance_unit), step);
        }
    if (fresh == 0) return;
    tree.visits[leaf] = add_visits<One>(visits, fresh);
    tree.pending_count[leaf] = 0;
}

/// Sums of children go up to their quadrants.
void gather(Quadtree& nodes) {
    for (std::size_t i = nodes.size(); i-- > 0;)
        for (int q = 0; q < 4; ++q)
            if (nodes[i].child[q] != 0) nodes[i].energy[q] = sum_of_quadrants(nodes[nodes[i].child[q]].energy);
}

/// The quadtree of a leaf whose quadrants have at most `share` of its energy each; quadrants divided anew give each
/// quarter the same energy.
Quadtree divided(const HostSdTree& tree, std::uint32_t leaf, float share) {
    struct Origin {
        std::uint32_t node, depth;  ///< of the old tree, or kNone; depth of the new node
    };
    const std::uint32_t root = tree.first_node[leaf];
    const auto copy_of = [&](std::uint32_t node) {
        const float* e = &tree.energy[4 * std::size_t{node}];
        return QuadNode{{e[0], e[1], e[2], e[3]}, {}};
    };
    Quadtree nodes{copy_of(root)};
    std::vector<Origin> origins{{root, 0}};
    const float total = sum_of_quadrants(nodes[0].energy);
    const float few = kFewestInQuadrant / static_cast<float>(std::max(tree.visits[leaf], 1u));
    const float least = std::max(share, few) * total;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        for (std::uint32_t q = 0; q < 4; ++q) {
            const float energy = nodes[i].energy[q];
            const Origin origin = origins[i];
            if (!(energy > least) || origin.depth >= kMostQuadDepth) continue;
            const std::uint32_t below = origin.node == kNone ? 0 : tree.child[4 * std::size_t{origin.node} + q];
            const float quarter = 0.25f * energy;
            nodes[i].child[q] = static_cast<std::uint32_t>(nodes.size());
            nodes.push_back(below != 0 ? copy_of(root + below) : QuadNode{{quarter, quarter, quarter, quarter}, {}});
            origins.push_back({below != 0 ? root + below : kNone, origin.depth + 1});
        }
    gather(nodes);
    return nodes;
}

/// Halvings of a leaf before it has at most `most` training samples.
std::uint32_t halvings(double visits, double most) {
    std::uint32_t count = 0;
    for (; visits > most; visits *= 0.5) ++count;
    return count;
}

/// Training samples above which leaves are split: by the rule, or more if there would be too many leaves.
double split_bound(const FieldShape& shape, const HostSdTree& tree) {
    double samples = 0.0;
    for (const std::uint32_t visits : tree.visits) samples += visits;
    double bound = std::max(kSplitSamples * std::sqrt(samples / kSplitReference), kFewestSplitSamples);
    const double most = std::max(1u, shape.most_nodes / kNodesPerLeaf);
    const auto leaves = [&] {
        double count = 0.0;
        for (const std::uint32_t visits : tree.visits) count += std::exp2(halvings(visits, bound));
        return count;
    };
    while (bound < samples && leaves() > most) bound *= 2.0;
    return bound;
}

/// A leaf of the new tree over space.
struct NewLeaf {
    std::uint32_t old;
    std::uint32_t visits;
    std::uint32_t halvings;
};

/// The tree over space with leaves split until they have at most `bound` training samples. Fills `leaves` by their new numbers.
LargeArray<std::uint32_t> split_space(const HostSdTree& tree, double bound, std::vector<NewLeaf>& leaves) {
    struct Task {
        std::uint32_t node;  ///< of the new tree
        SpatialNode from;    ///< of the old one
        std::uint32_t depth;
        NewLeaf leaf;  ///< if `from` is one
    };
    LargeArray<std::uint32_t> nodes(1);
    const auto leaf_of = [&](SpatialNode node) {
        return node.is_leaf() ? NewLeaf{node.number(), tree.visits[node.number()], 0} : NewLeaf{};
    };
    const SpatialNode root{tree.spatial[0]};
    std::vector<Task> tasks{{0, root, 0, leaf_of(root)}};
    while (!tasks.empty()) {
        const Task task = tasks.back();
        tasks.pop_back();
        const auto children = static_cast<std::uint32_t>(nodes.size());
        const bool is_split = task.leaf.visits > bound && task.depth < kMostSpatialDepth;
        if (task.from.is_leaf() && !is_split) {
            nodes[task.node] = SpatialNode::kIsLeaf | static_cast<std::uint32_t>(leaves.size());
            leaves.push_back(task.leaf);
            continue;
        }
        nodes[task.node] = children;
        nodes.resize(children + 2);
        for (std::uint32_t i = 2; i-- > 0;) {
            SpatialNode from = task.from;
            NewLeaf leaf{task.leaf.old, (task.leaf.visits + i) / 2, task.leaf.halvings + 1};
            if (!task.from.is_leaf()) {
                from = {tree.spatial[task.from.number() + i]};
                leaf = leaf_of(from);
            }
            tasks.push_back({children + i, from, task.depth + 1, leaf});
        }
    }
    return nodes;
}

/// The quadtrees of all old leaves, with at most `most` nodes in the new ones: by the least doubling of the share that suffices.
std::vector<Quadtree> divide_directions(const HostSdTree& tree, const std::vector<NewLeaf>& leaves, std::size_t most,
                                        int threads) {
    std::vector<Quadtree> quadtrees(tree.first_node.size());
    for (float share = kDividedShare;; share *= 2.0f) {
        for_chunks(static_cast<std::uint32_t>(quadtrees.size()), kLeafChunk, threads, [&](IndexRange range) {
            for (std::uint32_t leaf = range.begin; leaf < range.end; ++leaf)
                quadtrees[leaf] = divided(tree, leaf, share);
        });
        std::size_t nodes = 0;
        for (const NewLeaf& leaf : leaves) nodes += quadtrees[leaf.old].size();
        if (nodes <= most || share > 1.0f) return quadtrees;
    }
}

void write_quadtree(const Quadtree& nodes, std::uint32_t first, HostSdTree& tree) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        std::copy_n(nodes[i].energy, 4, &tree.energy[4 * (first + i)]);
        std::copy_n(nodes[i].child, 4, &tree.child[4 * (first + i)]);
    }
}

/// The arrays of leaves and slots of the new trees, without pending sums.
void rebuild(HostSdTree& tree, const std::vector<NewLeaf>& leaves, const std::vector<Quadtree>& quadtrees,
             int threads) {
    HostSdTree next;
    std::uint32_t nodes = 0;
    for (const NewLeaf& leaf : leaves) {
        const float part = std::ldexp(1.0f, -static_cast<int>(leaf.halvings));
        next.first_node.push_back(nodes);
        next.visits.push_back(leaf.visits);
        next.mixture_target.push_back(part * tree.mixture_target[leaf.old]);
        next.mixture_weight.push_back(part * tree.mixture_weight[leaf.old]);
        next.bsdf_fraction.push_back(tree.bsdf_fraction[leaf.old]);
        nodes += static_cast<std::uint32_t>(quadtrees[leaf.old].size());
    }
    next.energy.resize(4 * std::size_t{nodes});
    next.child.resize(next.energy.size());
    for_chunks(static_cast<std::uint32_t>(leaves.size()), kLeafChunk, threads, [&](IndexRange range) {
        for (std::uint32_t leaf = range.begin; leaf < range.end; ++leaf)
            write_quadtree(quadtrees[leaves[leaf].old], next.first_node[leaf], next);
    });
    tree.first_node = std::move(next.first_node);
    tree.energy = std::move(next.energy);
    tree.child = std::move(next.child);
    tree.visits = std::move(next.visits);
    tree.mixture_target = std::move(next.mixture_target);
    tree.mixture_weight = std::move(next.mixture_weight);
    tree.bsdf_fraction = std::move(next.bsdf_fraction);
    tree.pending_energy.assign(tree.energy.size(), 0);
    tree.pending_count.assign(leaves.size(), 0);
    tree.pending_slope.assign(leaves.size(), 0);
    tree.pending_curvature.assign(leaves.size(), 0);
}

}  // namespace

void SdTreeModel::update(const FieldShape& shape, const HostVolumes&, HostSdTree& tree, int threads) {
    const VolumeUpdateView view = volume_update_view(shape, tree);
    for_chunks(static_cast<std::uint32_t>(volume_count(tree)), kVolumeChunk, threads, [&](IndexRange range) {
        for (std::uint32_t volume = range.begin; volume < range.end; ++volume) absorb_volume(view, volume);
    });
    const auto old_leaves = static_cast<std::uint32_t>(tree.first_node.size());
    const auto old_nodes = static_cast<std::uint32_t>(tree.energy.size() / 4);
    for_chunks(old_leaves, kLeafChunk, threads, [&](IndexRange range) {
        for (std::uint32_t leaf = range.begin; leaf < range.end; ++leaf) {
            const std::uint32_t end = leaf + 1 < old_leaves ? tree.first_node[leaf + 1] : old_nodes;
            absorb_leaf(shape, tree, leaf, tree.first_node[leaf], end);
            move_mixture(view, leaf);
        }
    });
    std::vector<NewLeaf> leaves;
    LargeArray<std::uint32_t> space = split_space(tree, split_bound(shape, tree), leaves);
    const std::vector<Quadtree> quadtrees = divide_directions(tree, leaves, shape.most_nodes, threads);
    tree.spatial = std::move(space);
    rebuild(tree, leaves, quadtrees, threads);
}

}  // namespace pl
