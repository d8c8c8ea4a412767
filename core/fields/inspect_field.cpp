#include "core/fields/inspect_field.h"

namespace pl {

VolumeInspection inspect_volume(const AnyFieldView& field, std::int32_t volume) {
    return visit_field(field, [&](const auto& view) {
        const FieldInspector auto inspector = inspector_of(view);
        const auto index = static_cast<std::uint32_t>(volume);
        VolumeInspection result{.volume = volume,
                                .position = view.sites[index].position,
                                .normal = view.normals[index],
                                .side = inspector.cells().side,
                                .radiance = {},
                                .probability = {},
                                .visits = {},
                                .mean_radiance = inspector.mean_radiance(volume)};
        for (int cell = 0; cell < inspector.cells().count(); ++cell) {
            result.radiance.push_back(inspector.radiance(volume, cell));
            result.probability.push_back(inspector.probability(volume, cell));
            result.visits.push_back(inspector.samples(volume, cell));
        }
        return result;
    });
}

}  // namespace pl
