#include "core/fields/reset_tables.h"

#include <algorithm>

namespace pl {

void forget_volume(const FieldShape& shape, HostField& field, std::size_t volume) {
    HostTables& tables = tables_of(field);
    const std::size_t volumes = volume_count(tables);
    for_each_table_array([&](const auto& spec) {
        auto& values = spec.get(tables);
        using Value = std::remove_cvref_t<decltype(values[0])>;
        const std::size_t length = extent_of(spec.extent, shape, volumes) / volumes;
        for (std::size_t i = volume * length; i < (volume + 1) * length; ++i)
            values[i] = static_cast<Value>(spec.initial(shape, i));
    });
}

/// Pending sums are the arrays that a split clears.
void drop_pending(HostField& field) {
    for_each_table_array([&](const auto& spec) {
        auto& values = spec.get(tables_of(field));
        using Value = std::remove_cvref_t<decltype(values[0])>;
        if (spec.on_split == OnSplit::Clear) std::fill_n(&values[0], values.size(), Value{});
    });
}

}  // namespace pl
