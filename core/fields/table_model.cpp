#include "core/fields/table_model.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace pl {
namespace {

std::size_t rounded_root(int bins) {
    return static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(bins))));
}

/// Appends a copy of each parent's values to those of all volumes.
template <class Array>
void append_copies(Array& array, std::size_t volumes, std::span<const std::uint32_t> parents) {
    const std::size_t per_volume = array.size() / volumes;
    array.resize(array.size() + parents.size() * per_volume);
    for (std::size_t i = 0; i < parents.size(); ++i)
        std::copy_n(array.data() + parents[i] * per_volume, per_volume, array.data() + (volumes + i) * per_volume);
}

/// Divides a count between a volume and its copy. Odd counts go to the child in every second cell of a checkerboard,
/// so that cells with one training sample each leave both volumes with samples all over their hemispheres.
template <class T>
void split_value(OnSplit rule, T& parent, T& child, bool odd_to_child) {
    if (rule == OnSplit::Clear) child = T{};
    if (rule == OnSplit::Halve) parent = child = static_cast<T>(static_cast<float>(parent) * 0.5f);
    if constexpr (std::is_same_v<T, std::uint32_t>) {
        if (rule != OnSplit::Divide) return;
        child = parent / 2 + (odd_to_child ? parent % 2 : 0);
        parent -= child;
    }
}

/// Cells that the division left without training samples have no radiance.
void clear_unvisited(HostTables& tables, std::size_t volume, std::size_t cells) {
    for (std::size_t cell = volume * cells; cell < (volume + 1) * cells; ++cell)
        if (tables.visits[cell] == 0) tables.radiance[cell] = 0.0f;
}

}  // namespace

HostTables make_tables(const FieldShape& shape, std::size_t volumes) {
    HostTables tables;
    for_each_table_array([&](const auto& spec) {
        auto& array = spec.get(tables);
        using Value = typename std::remove_reference_t<decltype(array)>::value_type;
        array.resize(extent_of(spec.extent, shape, volumes));
        for (std::size_t i = 0; i < array.size(); ++i) array[i] = static_cast<Value>(spec.initial(shape, i));
    });
    return tables;
}

bool fits(const FieldShape& shape, const HostTables& tables, std::size_t volumes) {
    bool all = true;
    for_each_table_array(
        [&](const auto& spec) { all = all && spec.get(tables).size() == extent_of(spec.extent, shape, volumes); });
    return all;
}

std::size_t table_bytes(int bins, std::size_t light_clusters) {
    const FieldShape shape{.cells = {static_cast<int>(rounded_root(bins))},
                           .light_clusters = static_cast<std::uint32_t>(light_clusters)};
    std::size_t bytes = 0;
    const HostTables tables;
    for_each_table_array(
        [&](const auto& spec) { bytes += extent_of(spec.extent, shape, 1) * sizeof spec.get(tables)[0]; });
    return bytes;
}

std::size_t field_bytes(const HostTables& tables) {
    std::size_t bytes = 0;
    for_each_table_array([&](const auto& spec) {
        const auto& array = spec.get(tables);
        bytes += array.size() * sizeof array[0];
    });
    return bytes;
}

HostTables split_field(const FieldShape& shape, HostTables tables, std::span<const std::uint32_t> parents) {
    const std::size_t volumes = volume_count(tables);
    const auto side = static_cast<std::size_t>(shape.cells.side);
    for_each_table_array([&](const auto& spec) {
        auto& array = spec.get(tables);
        const std::size_t per_volume = extent_of(spec.extent, shape, 1);
        append_copies(array, volumes, parents);
        for (std::size_t i = 0; i < parents.size(); ++i)
            for (std::size_t k = 0; k < per_volume; ++k)
                split_value(spec.on_split, array[parents[i] * per_volume + k], array[(volumes + i) * per_volume + k],
                            (k / side + k % side) % 2 != 0);
    });
    for (std::size_t i = 0; i < parents.size(); ++i) {
        clear_unvisited(tables, parents[i], side * side);
        clear_unvisited(tables, volumes + i, side * side);
    }
    return tables;
}

}  // namespace pl
