#include "core/fields/inspect_field.h"

namespace pl {

std::uint32_t fine_cell_of(int side, Vec2f square) {
    const DirectionCells fine{.side = side * kFinePoints};
    return static_cast<std::uint32_t>(fine.cell_of(square));
}

std::vector<float> cell_shares(int side, std::span<const float> fine_density) {
    const int points = side * kFinePoints;
    std::vector<float> shares(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0.0f);
    const float weight = 1.0f / (static_cast<float>(points) * static_cast<float>(points));
    for (int i = 0; i < points * points; ++i) {
        const int cell = (i / points / kFinePoints) * side + i % points / kFinePoints;
        shares[static_cast<std::size_t>(cell)] += weight * fine_density[static_cast<std::size_t>(i)];
    }
    return shares;
}

VolumeInspection inspect_volume(const AnyFieldView& field, std::int32_t volume) {
    return visit_field(field, [&](const auto& view) {
        const FieldInspector auto inspector = inspector_of(view);
        const auto index = static_cast<std::uint32_t>(volume);
        VolumeInspection result{.volume = volume,
                                .position = view.sites[index].position,
                                .normal = view.normals[index],
                                .site = view.sites[index],
                                .side = inspector.cells().side,
                                .radiance = {},
                                .probability = {},
                                .visits = {},
                                .density = {},
                                .mean_radiance = inspector.mean_radiance(volume),
                                .bsdf_fraction = inspector.bsdf_fraction(volume)};
        for (int cell = 0; cell < inspector.cells().count(); ++cell) {
            result.radiance.push_back(inspector.radiance(volume, cell));
            result.probability.push_back(inspector.probability(volume, cell));
            result.visits.push_back(inspector.samples(volume, cell));
        }
        for_each_fine_point(result.side,
                            [&](Vec2f square) { result.density.push_back(inspector.density(volume, square)); });
        return result;
    });
}

}  // namespace pl
