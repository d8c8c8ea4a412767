#include "core/fields/inspect_field.h"

#include <algorithm>

namespace pl {
namespace {

/// Returns visit(view, inspector) of the field.
template <class Result, class Visit>
Result with_inspector(const AnyFieldView& field, Visit&& visit) {
    Result result{};
    any_entry<FieldModels>([&]<int kIndex>() {
        const auto* view = std::get_if<kIndex + 1>(&field);
        if (view != nullptr) result = visit(*view, TypeAt<kIndex, FieldModels>::inspector(*view));
        return view != nullptr;
    });
    return result;
}

}  // namespace

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

std::vector<float> cell_probabilities(const AnyFieldView& field, std::int32_t volume) {
    return with_inspector<std::vector<float>>(field, [&](const auto& view, const FieldInspector auto& inspector) {
        std::vector<float> shares;
        for (int cell = 0; cell < view.cells.count(); ++cell)
            shares.push_back(inspector.probability(static_cast<std::uint32_t>(volume), cell));
        return shares;
    });
}

VolumeInspection inspect_volume(const AnyFieldView& field, std::int32_t volume) {
    return with_inspector<VolumeInspection>(field, [&](const auto& view, const FieldInspector auto& inspector) {
        const auto index = static_cast<std::uint32_t>(volume);
        VolumeInspection result{.volume = volume,
                                .position = view.sites[index].position,
                                .normal = view.normals[index],
                                .site = view.sites[index],
                                .side = view.cells.side,
                                .radiance = {},
                                .probability = {},
                                .visits = {},
                                .density = {},
                                .mean_radiance = view.mean_radiance[index],
                                .bsdf_fraction = inspector.bsdf_fraction(index)};
        for (int cell = 0; cell < view.cells.count(); ++cell) {
            result.radiance.push_back(inspector.radiance(index, cell));
            result.probability.push_back(inspector.probability(index, cell));
            result.visits.push_back(inspector.samples(index, cell));
        }
        for_each_fine_point(result.side,
                            [&](Vec2f square) { result.density.push_back(inspector.density(index, square)); });
        return result;
    });
}

}  // namespace pl
