#include "core/fields/reset_tables.h"

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

}  // namespace pl
