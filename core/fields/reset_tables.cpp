#include "core/fields/reset_tables.h"

#include <algorithm>

namespace pl {
namespace {

/// Sets the values [first, end) of an array.
template <class Array>
void reset(Array& values, std::size_t first, std::size_t end, float initial) {
    using Value = std::remove_cvref_t<decltype(values[0])>;
    std::fill(values.begin() + static_cast<std::ptrdiff_t>(first), values.begin() + static_cast<std::ptrdiff_t>(end),
              static_cast<Value>(initial));
}

void forget(const FieldShape& shape, const HostVolumes&, HostTables& tables, std::size_t volume) {
    const std::size_t volumes = volume_count(tables);
    for_each_table_array([&](const auto& spec) {
        auto& values = spec.get(tables);
        using Value = std::remove_cvref_t<decltype(values[0])>;
        const std::size_t length = extent_of(spec.extent, shape, volumes) / volumes;
        for (std::size_t i = volume * length; i < (volume + 1) * length; ++i)
            values[i] = static_cast<Value>(spec.initial(shape, i));
    });
}

/// The network, of all volumes, stays.
void forget(const FieldShape& shape, const HostVolumes& volumes, HostNeural& field, std::size_t volume) {
    forget(shape, volumes, static_cast<HostTables&>(field), volume);
}

void forget(const FieldShape& shape, const HostVolumes&, HostLobes& lobes, std::size_t volume) {
    reset_lobes(shape, lobes, volume);
}

/// The shape of the quadtree stays: the next update joins its quadrants.
void forget(const FieldShape& shape, const HostVolumes& volumes, HostSdTree& tree, std::size_t volume) {
    const SdTreeField field = field_view(shape, volumes, tree);
    const std::size_t leaf = SdTreeVolumeSummary{field}.leaf_of(static_cast<std::uint32_t>(volume));
    const std::size_t first = 4 * std::size_t{tree.first_node[leaf]};
    const std::size_t end =
        leaf + 1 < tree.first_node.size() ? 4 * std::size_t{tree.first_node[leaf + 1]} : tree.energy.size();
    for_each_sd_tree_array([&](const auto& spec) {
        if (spec.part == SdTreePart::Structure) return;
        auto& values = spec.get(tree);
        switch (spec.extent) {
        case SdTreeExtent::SpatialNode: return;
        case SdTreeExtent::Leaf: return reset(values, leaf, leaf + 1, spec.initial);
        case SdTreeExtent::Slot: return reset(values, first, end, spec.initial);
        case SdTreeExtent::Volume: return reset(values, volume, volume + 1, spec.initial);
        case SdTreeExtent::LightCluster:
            return reset(values, volume * shape.light_clusters, (volume + 1) * shape.light_clusters, spec.initial);
        }
    });
}

}  // namespace

void forget_volume(const FieldShape& shape, const HostVolumes& volumes, HostField& field, std::size_t volume) {
    std::visit([&](auto& arrays) { forget(shape, volumes, arrays, volume); }, field);
}

}  // namespace pl
