#include "cpu/learning/field_update.h"

#include "cpu/learning/neural_update.h"

namespace pl {

void update_field(const FieldShape& shape, const HostVolumes& volumes, HostField& field, bool is_updated,
                  int threads) {
    std::visit(
        [&](auto& arrays) {
            using Storage = std::remove_cvref_t<decltype(arrays)>;
            if constexpr (std::derived_from<Storage, HostTables>) {
                const LaneKernels& kernels = best_lane_kernels();
                const TableUpdateView view = update_view(shape, static_cast<HostTables&>(arrays));
                for_each_volume(volume_count(arrays), threads, [&](std::uint32_t volume) {
                    if (!is_updated || has_new_samples(kernels, view, volume))
                        update_volume_in_lanes(kernels, view, volume);
                });
                if constexpr (std::same_as<Storage, HostNeural>) update_network(shape, volumes, arrays, threads);
            } else {
                ModelOf<Storage>::update(shape, volumes, arrays, threads);
            }
        },
        field);
}

}  // namespace pl
