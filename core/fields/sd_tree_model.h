// The SD-tree as a representation on the host.
#pragma once

#include "core/fields/representation.h"
#include "core/kernel/guiding/sd_tree_field.h"

namespace pl {

template <template <class> class Array>
using SdTreeStorage = SdTreeArrays<Array, Array>;
using HostSdTree = SdTreeStorage<LargeArray>;

namespace sd_tree_arrays {

// Lengths that go together: a leaf at least, a node of its quadtree for each leaf at least, and four quadrants to a node.
inline std::size_t leaves_of(const HostSdTree& tree) { return std::max<std::size_t>(tree.first_node.size(), 1); }
inline constexpr ArrayOwner kOfLeaf{"leaf", leaves_of};
inline constexpr ArrayOwner kOfPlace{"place", [](const HostSdTree& tree) { return 2 * leaves_of(tree) - 1; }};
inline constexpr ArrayOwner kOfSlot{
    "quadrant", [](const HostSdTree& tree) {
        return 4 * std::max(std::min<std::size_t>(tree.energy.size() / 4, kMostQuadNodes), leaves_of(tree));
    }};

inline constexpr auto kLeafOfAll = [](const FieldShape&, std::size_t) { return SpatialNode::kIsLeaf; };

using enum OnSplit;
using enum ValidRange;

// clang-format off
/// A tree of one leaf for all of space, with one node: uniform.
inline constexpr auto kAll = SpecList{
    ArraySpec{"nodes of space", "node of space", kOfPlace, Copy, Any, kLeafOfAll, [](auto& t) -> auto& { return t.spatial; }},
    ArraySpec{"roots of quadtrees", "root of a quadtree", kOfLeaf, Copy, Any, kZero, [](auto& t) -> auto& { return t.first_node; }},
    ArraySpec{"energies", "energy", kOfSlot, Copy, Amount, kZero, [](auto& t) -> auto& { return t.energy; }},
    ArraySpec{"children", "child", kOfSlot, Copy, Any, kZero, [](auto& t) -> auto& { return t.child; }},
    ArraySpec{"sums of energies", "sum of energies", kOfSlot, Clear, NotNegative, kZero, [](auto& t) -> auto& { return t.pending_energy; }},
    ArraySpec{"visits", "visits", kOfLeaf, Copy, Any, kZero, [](auto& t) -> auto& { return t.visits; }},
    ArraySpec{"counts", "count", kOfLeaf, Clear, Any, kZero, [](auto& t) -> auto& { return t.pending_count; }},
} + mixture_arrays(kOfLeaf) + kIrradianceArrays + kLightArrays;
// clang-format on

}  // namespace sd_tree_arrays

/// An SD-tree, by the leaf at the site of a volume and the volume's irradiance; single directions by the cells that tables have.
struct SdTreeInspector : IrradianceSummary<SdTreeField> {
    std::uint32_t leaf_of(std::uint32_t volume) const {
        return field.leaf_at(field.in_cube(field.sites[volume].position)).leaf;
    }
    using IrradianceSummary<SdTreeField>::samples;
    /// Share of the sphere without light, as far as the leaf knows.
    float unvisited_share(std::uint32_t volume) const;
    /// Entropy of equal cells of the sphere, as many as tables have: log2(cells) for a uniform tree, at least 0.
    float entropy(std::uint32_t volume) const;
    float bsdf_fraction(std::uint32_t volume) const { return field.bsdf_fraction[leaf_of(volume)]; }

    float radiance(std::uint32_t volume, int cell) const;
    float probability(std::uint32_t volume, int cell) const;
    /// The training samples of the volume, spread over the cells by their probability.
    std::uint32_t samples(std::uint32_t volume, int cell) const;
    float density(std::uint32_t volume, Vec2f square) const;
};

// Of the update.   [Mueller et al. 2017, section 3]

/// Share of a leaf's energy above which a quadrant is divided.   [Mueller et al. 2017: rho = 0.01]
inline constexpr float kDividedShare = 0.01f;

/// Training samples of a leaf above which it is split: kSplitSamples sqrt(n / kSplitReference), n the training
/// samples of all leaves, and at least kFewestSplitSamples. In the paper c sqrt(2^k) in iteration k, whose samples
/// have doubled so often; the reference is the number of samples of a first iteration, four paths for each of a
/// million pixels. c is 12 000 in 2017 and 4000 in 2019.
inline constexpr double kSplitSamples = 4000.0;
inline constexpr double kSplitReference = 16777216.0;
inline constexpr double kFewestSplitSamples = 2000.0;

/// Training samples that a quadrant is to have, on the mean, before it is divided: fewer say nothing of its quarters. Leaves of the
/// first updates are small; the paper's have thousands. Measured from 8 to 100, see docs/notebook/2026-11-25-sd-tree.md.
inline constexpr float kFewestInQuadrant = 60.0f;

struct SdTreeModel {
    using Field = SdTreeField;
    template <template <class> class Array>
    using Storage = SdTreeStorage<Array>;

    static constexpr ChoiceInfo<Representation> kInfo{
        .value = Representation::SdTree,
        .name = "sd-tree",
        .label = "SD-tree",
        .sentence = "quadtrees over directions at the leaves of a tree over space, on the CPU alone"};
    static constexpr double kGuidance = 3.0;
    static constexpr const auto& kArrays = sd_tree_arrays::kAll;

    template <template <class> class Array, template <class> class TreeArray>
    static SdTreeField view(const FieldShape& shape, const VolumeStorage<Array>& volumes,
                            SdTreeStorage<TreeArray>& tree) {
        SdTreeField field;
        set_common(shape, placement_view(volumes, shape.extent), field);
        field.corner = shape.corner;
        field.inverse_edge = 1.0f / shape.edge;
        set_arrays(kArrays, field, tree);
        return field;
    }
    template <template <class> class Array>
    static SdTreeInspector summary(const FieldShape& shape, const HostVolumes& volumes, SdTreeStorage<Array>& tree) {
        return {view(shape, volumes, tree)};
    }
    static SdTreeInspector inspector(const SdTreeField& field) { return {field}; }
    /// Its leaves and nodes.
    static std::string text(const FieldShape&, const HostSdTree& tree);

    /// Absorbs all pending sums, splits leaves by their number of training samples, and divides or joins quadrants by their energy. A
    /// tree that would have more than shape.most_nodes nodes gets fewer leaves, and quadrants by a larger share.
    static void update(const FieldShape& shape, const HostVolumes&, HostSdTree& tree, int threads);
    /// The leaf at the volume forgets its directions with it. The shape of the quadtree stays: the next update joins its quadrants.
    static void forget(const FieldShape& shape, const HostVolumes& volumes, HostSdTree& tree, std::size_t volume);
    /// Nodes out of order, unreachable, shared or too deep, or sums that differ from the sums of the children.
    /// Without damage every lookup ends at a leaf and at a slot that exist, and samples follow the densities.
    static std::optional<FieldDamage> damage(const HostSdTree& tree);

    static constexpr std::uint32_t kMostNodes = kMostQuadNodes;
    /// Bytes of a node of a quadtree, at most.
    static std::size_t bytes_of_node();
};
template <template <class> class Array>
SdTreeModel model_of(const SdTreeStorage<Array>&);
static_assert(FieldModel<SdTreeModel>);

}  // namespace pl
