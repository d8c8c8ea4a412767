// The SD-tree as a model of a guiding field on the host: the one description of its arrays, and all code derived from it.
#pragma once

#include <optional>
#include <string>

#include "core/fields/table_model.h"
#include "core/kernel/guiding/sd_tree_field.h"

namespace pl {

template <template <class> class Array>
using SdTreeStorage = SdTreeArrays<Array, Array>;
using HostSdTree = SdTreeStorage<LargeArray>;

/// The owners of an array's values.
enum class SdTreeExtent { SpatialNode, Leaf, Slot, Volume, LightCluster };

/// The part of an array: the shape of the trees, or values of their nodes and of volumes.
enum class SdTreePart { Structure, Values };

/// Description of one array of SdTreeArrays.
template <class Get>
struct SdTreeSpec {
    const char* name;    ///< plural, in messages
    const char* single;  ///< of one value, in messages
    SdTreeExtent extent;
    SdTreePart part;
    OnSplit on_split;  ///< of a radiance volume
    ValidRange valid;
    float initial;  ///< all values of a field without training samples
    Get get;        ///< the array of any SdTreeArrays
};
template <class Get>
SdTreeSpec(const char*, const char*, SdTreeExtent, SdTreePart, OnSplit, ValidRange, float, Get) -> SdTreeSpec<Get>;

namespace sd_tree_arrays {

using enum SdTreeExtent;
using enum SdTreePart;
using enum OnSplit;
using enum ValidRange;

/// The arrays in the order of files.
// clang-format off
inline constexpr SpecList kAll{
    SdTreeSpec{"nodes of space", "node of space", SpatialNode, Structure, Copy, Any, 0.0f, [](auto& t) -> auto& { return t.spatial; }},
    SdTreeSpec{"roots of quadtrees", "root of a quadtree", Leaf, Structure, Copy, Any, 0.0f, [](auto& t) -> auto& { return t.first_node; }},
    SdTreeSpec{"energies", "energy", Slot, Values, Copy, Amount, 0.0f, [](auto& t) -> auto& { return t.energy; }},
    SdTreeSpec{"children", "child", Slot, Structure, Copy, Any, 0.0f, [](auto& t) -> auto& { return t.child; }},
    SdTreeSpec{"sums of energies", "sum of energies", Slot, Values, Clear, NotNegative, 0.0f, [](auto& t) -> auto& { return t.pending_energy; }},
    SdTreeSpec{"visits", "visits", Leaf, Values, Copy, Any, 0.0f, [](auto& t) -> auto& { return t.visits; }},
    SdTreeSpec{"counts", "count", Leaf, Values, Clear, Any, 0.0f, [](auto& t) -> auto& { return t.pending_count; }},
    SdTreeSpec{"slopes of the mixture", "slope of the mixture", Leaf, Values, Clear, Any, 0.0f, [](auto& t) -> auto& { return t.pending_slope; }},
    SdTreeSpec{"curvatures of the mixture", "curvature of the mixture", Leaf, Values, Clear, NotNegative, 0.0f, [](auto& t) -> auto& { return t.pending_curvature; }},
    SdTreeSpec{"targets of the mixture", "target of the mixture", Leaf, Values, Copy, Finite, 0.0f, [](auto& t) -> auto& { return t.mixture_target; }},
    SdTreeSpec{"weights of the mixture", "weight of the mixture", Leaf, Values, Copy, Amount, 0.0f, [](auto& t) -> auto& { return t.mixture_weight; }},
    SdTreeSpec{"BSDF shares", "BSDF share", Leaf, Values, Copy, BsdfFraction, kInitialBsdfFraction, [](auto& t) -> auto& { return t.bsdf_fraction; }},
    SdTreeSpec{"mean radiance", "mean radiance", Volume, Values, Copy, Amount, 0.0f, [](auto& t) -> auto& { return t.mean_radiance; }},
    SdTreeSpec{"samples", "samples", Volume, Values, Divide, Any, 0.0f, [](auto& t) -> auto& { return t.samples; }},
    SdTreeSpec{"sums of values", "sum of values", Volume, Values, Clear, NotNegative, 0.0f, [](auto& t) -> auto& { return t.pending_value; }},
    SdTreeSpec{"sums of weights", "sum of weights", Volume, Values, Clear, NotNegative, 0.0f, [](auto& t) -> auto& { return t.pending_weight; }},
    SdTreeSpec{"new samples", "new samples", Volume, Values, Clear, Any, 0.0f, [](auto& t) -> auto& { return t.pending_samples; }},
    SdTreeSpec{"changes", "change", Volume, Values, Copy, Amount, 0.0f, [](auto& t) -> auto& { return t.change; }},
    SdTreeSpec{"sums of direct light", "sum of direct light", Volume, Values, Clear, NotNegative, 0.0f, [](auto& t) -> auto& { return t.pending_direct; }},
    SdTreeSpec{"counts of light samples", "count of light samples", Volume, Values, Clear, Any, 0.0f, [](auto& t) -> auto& { return t.pending_direct_count; }},
    SdTreeSpec{"direct light", "direct light", Volume, Values, Copy, Amount, 0.0f, [](auto& t) -> auto& { return t.direct; }},
    SdTreeSpec{"light samples", "light samples", Volume, Values, Divide, Any, 0.0f, [](auto& t) -> auto& { return t.direct_count; }},
    SdTreeSpec{"sums of light by clusters", "sum of light by a cluster", LightCluster, Values, Clear, NotNegative, 0.0f, [](auto& t) -> auto& { return t.pending_cluster; }},
    SdTreeSpec{"light by clusters", "light by a cluster", LightCluster, Values, Copy, Amount, 0.0f, [](auto& t) -> auto& { return t.cluster_light; }},
    SdTreeSpec{"choices of lights", "choice of lights", LightCluster, Values, Copy, Choice, 0.0f, [](auto& t) -> auto& { return t.light_cdf; }},
};
// clang-format on

}  // namespace sd_tree_arrays

/// Calls fn(spec) for every array.
template <class Fn>
constexpr void for_each_sd_tree_array(Fn&& fn) {
    for_each_spec(sd_tree_arrays::kAll, fn);
}

/// Calls fn(array of `from`, array of `to`) for every array; `to` is const if fn only reads it.
template <template <class> class From, class To, class Fn>
void zip(const SdTreeArrays<From, From>& from, To& to, Fn&& fn) {
    for_each_sd_tree_array([&](const auto& spec) { fn(spec.get(from), spec.get(to)); });
}

/// One leaf for all of space, with one node: uniform.
HostSdTree make_sd_tree(const FieldShape& shape, std::size_t volumes);

/// Number of values of an array of this tree, by the lengths of the others.
std::size_t extent_of(SdTreeExtent extent, const FieldShape& shape, const HostSdTree& tree, std::size_t volumes);
/// Whether all arrays have the lengths that follow from the shape, the number of volumes, and each other.
bool fits(const FieldShape& shape, const HostSdTree& tree, std::size_t volumes);
std::size_t field_bytes(const HostSdTree& tree);
inline std::size_t volume_count(const HostSdTree& tree) { return tree.mean_radiance.size(); }

/// Bytes of an SD-tree besides its volumes, for each node of its quadtrees, at most.
std::size_t sd_tree_bytes_per_node();
/// Bytes of an SD-tree for each volume.
std::size_t sd_tree_bytes_per_volume(std::size_t light_clusters);

/// New volumes begin with the irradiance of their parents; the trees stay.
HostSdTree split_field(const FieldShape& shape, HostSdTree tree, std::span<const std::uint32_t> parents);

/// The damage of an SD-tree whose arrays fit: nodes out of order, unreachable, shared or too deep, or sums that are not those of
/// children. Empty if there is none: then every lookup ends at a leaf and at a slot that exist, and densities are those of samples.
std::optional<std::string> damage_of(const HostSdTree& tree);

template <template <class> class Array, template <class> class TreeArray>
SdTreeField field_view(const FieldShape& shape, const VolumeStorage<Array>& volumes, SdTreeStorage<TreeArray>& tree) {
    SdTreeField field;
    static_cast<PlacementView&>(field) = placement_view(volumes, shape.extent);
    field.cells = shape.cells;
    field.light_clusters = shape.light_clusters;
    field.radiance_unit = shape.radiance_unit;
    field.corner = shape.corner;
    field.inverse_edge = 1.0f / shape.edge;
    for_each_sd_tree_array([&](const auto& spec) { spec.get(field) = view_of(spec.get(tree)); });
    return field;
}

/// VolumeSummary of an SD-tree: of the leaf at the site of a volume, and the volume's irradiance.
struct SdTreeVolumeSummary {
    SdTreeField field;

    std::uint32_t leaf_of(std::uint32_t volume) const {
        return field.leaf_at(field.in_cube(field.sites[volume].position)).leaf;
    }
    float samples(std::uint32_t volume) const { return static_cast<float>(field.samples[volume]); }
    /// Share of the sphere without light, as far as the leaf knows.
    float unvisited_share(std::uint32_t volume) const;
    /// That of equal cells of the sphere, as many as tables have: log2(cells) for a uniform tree, at least 0.
    float entropy(std::uint32_t volume) const;
    float mean_radiance(std::uint32_t volume) const { return field.mean_radiance[volume] + field.direct[volume]; }
    float change(std::uint32_t volume) const { return field.change[volume]; }
    float bsdf_fraction(std::uint32_t volume) const { return field.bsdf_fraction[leaf_of(volume)]; }
};
static_assert(VolumeSummary<SdTreeVolumeSummary>);

template <template <class> class Array>
SdTreeVolumeSummary summary_of(const FieldShape& shape, const HostVolumes& volumes, SdTreeStorage<Array>& tree) {
    return {field_view(shape, volumes, tree)};
}

}  // namespace pl
