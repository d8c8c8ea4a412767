#include "core/fields/sd_tree_model.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pl {
namespace {

/// Calls visit(slot, depth) for the slots without children of a leaf's quadtree.
template <class Visit>
void for_each_slot(const SdTreeView& field, std::uint32_t leaf, Visit&& visit) {
    std::vector<QuadSlot> waiting{{4 * field.first_node[leaf], 0}};  // first slots of nodes
    while (!waiting.empty()) {
        const QuadSlot node = waiting.back();
        waiting.pop_back();
        for (std::uint32_t slot = node.slot; slot < node.slot + 4; ++slot) {
            const std::uint32_t below = field.child[slot];
            if (below == 0)
                visit(QuadSlot{slot, node.depth});
            else
                waiting.push_back({4 * (field.first_node[leaf] + below), node.depth + 1});
        }
    }
}

std::string wrong(const char* part, std::size_t i, std::size_t got) {
    return std::string(part) + " " + std::to_string(i) + ": got " + std::to_string(got);
}

/// Follows the tree over space from its root; every node and every leaf has to be met once.
std::optional<std::string> damage_of_space(const HostSdTree& tree) {
    struct Visit {
        std::uint32_t node, depth;
    };
    std::vector<char> met(tree.first_node.size(), 0);
    std::vector<Visit> waiting{{0, 0}};
    std::size_t nodes = 0;
    while (!waiting.empty()) {
        const Visit visit = waiting.back();
        waiting.pop_back();
        ++nodes;
        const SpatialNode node{tree.spatial[visit.node]};
        const std::uint32_t number = node.number();
        if (node.is_leaf()) {
            if (number >= met.size() || met[number] != 0) return wrong("leaf of node", visit.node, number);
            met[number] = 1;
            continue;
        }
        // Children lie behind their parents, so that no way leads back.
        if (number <= visit.node || number + 1 >= tree.spatial.size() || visit.depth >= kMostSpatialDepth)
            return wrong("children of node", visit.node, number);
        waiting.push_back({number, visit.depth + 1});
        waiting.push_back({number + 1, visit.depth + 1});
        if (nodes + waiting.size() > tree.spatial.size()) return wrong("children of node", visit.node, number);
    }
    if (nodes != tree.spatial.size() || std::ranges::count(met, 0) > 0)
        return wrong("nodes of space that are reached: expected all of", tree.spatial.size(), nodes);
    return std::nullopt;
}

/// The same for one quadtree: the nodes [first, end). Quadrants hold the sums of their children, by which they are chosen.
std::optional<std::string> damage_of_quadtree(const HostSdTree& tree, std::uint32_t first, std::uint32_t end) {
    std::vector<std::uint32_t> depth(end - first, 0);
    std::vector<char> is_met(end - first, 0);
    for (std::uint32_t node = 0; node < end - first; ++node) {
        if (node > 0 && is_met[node] == 0) return wrong("parent of the node", first + node, 0);
        for (std::size_t slot = 4 * std::size_t{first + node}; slot < 4 * std::size_t{first + node + 1}; ++slot) {
            const std::uint32_t below = tree.child[slot];
            if (below == 0) continue;
            if (below <= node || below >= end - first || is_met[below] != 0 || depth[node] >= kMostQuadDepth)
                return wrong("child of the quadrant", slot, below);
            if (tree.energy[slot] != sum_of_quadrants(&tree.energy[4 * std::size_t{first + below}]))
                return wrong("energy of the quadrant", slot, below);
            is_met[below] = 1;
            depth[below] = depth[node] + 1;
        }
    }
    if (!(sum_of_quadrants(&tree.energy[4 * std::size_t{first}]) < kInfinity))
        return wrong("energy of root", first, 0);
    return std::nullopt;
}

}  // namespace

HostSdTree make_sd_tree(const FieldShape& shape, std::size_t volumes) {
    HostSdTree tree;
    tree.first_node.resize(1);
    tree.energy.resize(4);
    for_each_sd_tree_array([&](const auto& spec) {
        auto& values = spec.get(tree);
        using Value = std::remove_cvref_t<decltype(values[0])>;
        values.assign(extent_of(spec.extent, shape, tree, volumes), static_cast<Value>(spec.initial));
    });
    tree.spatial = {SpatialNode::kIsLeaf};
    return tree;
}

std::size_t extent_of(SdTreeExtent extent, const FieldShape& shape, const HostSdTree& tree, std::size_t volumes) {
    switch (extent) {
    case SdTreeExtent::SpatialNode: return 2 * tree.first_node.size() - 1;
    case SdTreeExtent::Leaf: return tree.first_node.size();
    case SdTreeExtent::Slot: return tree.energy.size();
    case SdTreeExtent::Volume: return volumes;
    case SdTreeExtent::LightCluster: return volumes * shape.light_clusters;
    }
    return 0;
}

bool fits(const FieldShape& shape, const HostSdTree& tree, std::size_t volumes) {
    const std::size_t leaves = tree.first_node.size();
    const std::size_t nodes = tree.energy.size() / 4;
    bool fits = leaves > 0 && nodes >= leaves && nodes <= kMostQuadNodes && tree.energy.size() == 4 * nodes;
    for_each_sd_tree_array([&](const auto& spec) {
        fits = fits && spec.get(tree).size() == extent_of(spec.extent, shape, tree, volumes);
    });
    return fits;
}

std::size_t field_bytes(const HostSdTree& tree) {
    std::size_t bytes = 0;
    for_each_sd_tree_array([&](const auto& spec) { bytes += spec.get(tree).size() * sizeof spec.get(tree)[0]; });
    return bytes;
}

std::size_t sd_tree_bytes_per_node() {
    std::size_t bytes = 0;
    // A quadtree has a node at least, and there are fewer than twice as many nodes of space as leaves.
    for_each_sd_tree_array([&](const auto& spec) {
        using Value = std::remove_cvref_t<decltype(spec.get(std::declval<HostSdTree&>())[0])>;
        if (spec.extent == SdTreeExtent::Slot) bytes += 4 * sizeof(Value);
        if (spec.extent == SdTreeExtent::Leaf) bytes += sizeof(Value);
        if (spec.extent == SdTreeExtent::SpatialNode) bytes += 2 * sizeof(Value);
    });
    return bytes;
}

std::size_t sd_tree_bytes_per_volume(std::size_t light_clusters) {
    std::size_t bytes = 0;
    for_each_sd_tree_array([&](const auto& spec) {
        using Value = std::remove_cvref_t<decltype(spec.get(std::declval<HostSdTree&>())[0])>;
        if (spec.extent == SdTreeExtent::Volume) bytes += sizeof(Value);
        if (spec.extent == SdTreeExtent::LightCluster) bytes += light_clusters * sizeof(Value);
    });
    return bytes;
}

HostSdTree split_field(const FieldShape& shape, HostSdTree tree, std::span<const std::uint32_t> parents) {
    const std::size_t volumes = volume_count(tree);
    for_each_sd_tree_array([&](const auto& spec) {
        if (spec.extent != SdTreeExtent::Volume && spec.extent != SdTreeExtent::LightCluster) return;
        auto& values = spec.get(tree);
        const std::size_t length = spec.extent == SdTreeExtent::Volume ? 1 : shape.light_clusters;
        values.resize((volumes + parents.size()) * length);
        for (std::size_t i = 0; i < parents.size(); ++i)
            for (std::size_t k = 0; k < length; ++k) {
                auto& parent = values[parents[i] * length + k];
                auto& child = values[(volumes + i) * length + k];
                if (spec.on_split == OnSplit::Copy) child = parent;
                if (spec.on_split != OnSplit::Divide) continue;
                child = parent / 2;
                parent -= child;
            }
    });
    return tree;
}

std::optional<std::string> damage_of(const HostSdTree& tree) {
    if (const auto damage = damage_of_space(tree)) return damage;
    const auto nodes = static_cast<std::uint32_t>(tree.energy.size() / 4);
    for (std::size_t leaf = 0; leaf < tree.first_node.size(); ++leaf) {
        const std::uint32_t first = tree.first_node[leaf];
        const std::uint32_t end = leaf + 1 < tree.first_node.size() ? tree.first_node[leaf + 1] : nodes;
        if ((leaf == 0 && first != 0) || end <= first || end > nodes) return wrong("root of leaf", leaf, first);
        if (const auto damage = damage_of_quadtree(tree, first, end)) return damage;
    }
    return std::nullopt;
}

float SdTreeVolumeSummary::unvisited_share(std::uint32_t volume) const {
    const std::uint32_t leaf = leaf_of(volume);
    float dark = 0.0f;
    for_each_slot(field, leaf, [&](const QuadSlot& slot) {
        if (!(field.energy[slot.slot] > 0.0f)) dark += slot.side() * slot.side();
    });
    return min_of(dark, 1.0f);
}

float SdTreeVolumeSummary::entropy(std::uint32_t volume) const {
    const std::uint32_t leaf = leaf_of(volume);
    float bits = std::log2(static_cast<float>(field.cells.count()));
    for_each_slot(field, leaf, [&](const QuadSlot& slot) {
        const float relative = field.slot_pdf_sa(leaf, slot) / kUniformSpherePdf;
        if (relative > 0.0f) bits -= slot.side() * slot.side() * relative * std::log2(relative);
    });
    return max_of(bits, 0.0f);
}

}  // namespace pl
