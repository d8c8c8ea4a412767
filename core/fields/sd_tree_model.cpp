#include "core/fields/sd_tree_model.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

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

std::optional<std::string> damage_of_trees(const HostSdTree& tree) {
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

}  // namespace

std::string SdTreeModel::text(const FieldShape&, const HostSdTree& tree) {
    return fmt::format("SD-tree of {} leaves and {} nodes", tree.first_node.size(), tree.energy.size() / 4);
}

void SdTreeModel::forget(const FieldShape& shape, const HostVolumes& volumes, HostSdTree& tree, std::size_t volume) {
    reset_volume(shape, tree, volume);
    const SdTreeField field = view(shape, volumes, tree);
    const std::size_t leaf = SdTreeInspector{field}.leaf_of(static_cast<std::uint32_t>(volume));
    const std::size_t first = 4 * std::size_t{tree.first_node[leaf]};
    const std::size_t end =
        leaf + 1 < tree.first_node.size() ? 4 * std::size_t{tree.first_node[leaf + 1]} : tree.energy.size();
    std::fill(tree.energy.begin() + static_cast<std::ptrdiff_t>(first),
              tree.energy.begin() + static_cast<std::ptrdiff_t>(end), 0.0f);
    std::fill(tree.pending_energy.begin() + static_cast<std::ptrdiff_t>(first),
              tree.pending_energy.begin() + static_cast<std::ptrdiff_t>(end), 0);
    tree.visits[leaf] = tree.pending_count[leaf] = 0;
    for_each_spec(mixture_arrays(sd_tree_arrays::kOfLeaf),
                  [&](const auto& spec) { reset_values(spec, shape, spec.get(tree), leaf, 1); });
}

std::size_t SdTreeModel::bytes_of_node() {
    // A quadtree has a node at least, and there are fewer than twice as many nodes of space as leaves.
    HostSdTree node;
    node.first_node.resize(1);
    node.energy.resize(4);
    std::size_t bytes = 0;
    for_each_array_of<HostSdTree>([&](const auto& spec) {
        using Spec = std::remove_cvref_t<decltype(spec)>;
        if constexpr (!kIsByVolume<Spec>) bytes += spec.owner.count(node) * sizeof spec.get(node)[0];
    });
    return bytes + sizeof node.spatial[0];
}

std::optional<FieldDamage> SdTreeModel::damage(const HostSdTree& tree) {
    const std::optional<std::string> found = damage_of_trees(tree);
    if (!found) return std::nullopt;
    return FieldDamage{"SD-tree", "each node and each leaf once, children behind their parents", *found};
}

float SdTreeInspector::unvisited_share(std::uint32_t volume) const {
    const std::uint32_t leaf = leaf_of(volume);
    float dark = 0.0f;
    for_each_slot(field, leaf, [&](const QuadSlot& slot) {
        if (!(field.energy[slot.slot] > 0.0f)) dark += slot.side() * slot.side();
    });
    return min_of(dark, 1.0f);
}

float SdTreeInspector::entropy(std::uint32_t volume) const {
    const std::uint32_t leaf = leaf_of(volume);
    float bits = std::log2(static_cast<float>(field.cells.count()));
    for_each_slot(field, leaf, [&](const QuadSlot& slot) {
        const float relative = field.slot_pdf_sa(leaf, slot) / kUniformSpherePdf;
        if (relative > 0.0f) bits -= slot.side() * slot.side() * relative * std::log2(relative);
    });
    return max_of(bits, 0.0f);
}

float SdTreeInspector::radiance(std::uint32_t volume, int cell) const {
    const std::uint32_t leaf = leaf_of(volume);
    return mean_of_cell(field.cells, cell, [&](Vec2f square) {
        const Vec3f wi = field.frame(static_cast<std::int32_t>(volume)).to_world(square_to_cosine_hemisphere(square));
        return field.radiance_of(field.slot_at(leaf, sphere_to_square(wi)));
    });
}

float SdTreeInspector::probability(std::uint32_t volume, int cell) const {
    const float mean = mean_of_cell(field.cells, cell, [&](Vec2f square) { return density(volume, square); });
    return mean / static_cast<float>(field.cells.count());
}

std::uint32_t SdTreeInspector::samples(std::uint32_t volume, int cell) const {
    return spread_samples(field.samples[volume], probability(volume, cell));
}

float SdTreeInspector::density(std::uint32_t volume, Vec2f square) const {
    const Vec3f local = square_to_cosine_hemisphere(square);
    return relative_to_cosine(
        field.direction_pdf_sa(leaf_of(volume), field.frame(static_cast<std::int32_t>(volume)).to_world(local)),
        local);
}

}  // namespace pl
