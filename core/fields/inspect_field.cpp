#include "core/fields/inspect_field.h"

#include <algorithm>

namespace pl {
namespace {

/// Calls visit(point) for the middles of the kFinePoints x kFinePoints parts of a cell.
template <class Visit>
void for_each_point_of(const DirectionCells& cells, int cell, Visit&& visit) {
    for (int row = 0; row < kFinePoints; ++row)
        for (int column = 0; column < kFinePoints; ++column)
            visit(cells.point_in_cell(cell, (Vec2f{column, row} + 0.5f) / static_cast<float>(kFinePoints)));
}

constexpr float kPointWeight = 1.0f / static_cast<float>(kFinePoints * kFinePoints);

/// The samples of a volume that fall to a cell of this probability.
std::uint32_t spread_samples(std::uint32_t all, float probability) {
    return static_cast<std::uint32_t>(all * std::min(1.0, static_cast<double>(probability)));
}

}  // namespace

float SdTreeInspector::radiance(std::int32_t volume, int cell) const {
    const std::uint32_t leaf = leaf_of(volume);
    float sum = 0.0f;
    for_each_point_of(field.cells, cell, [&](Vec2f square) {
        const Vec3f wi = field.frame(volume).to_world(square_to_cosine_hemisphere(square));
        sum += field.radiance_of(field.slot_at(leaf, sphere_to_square(wi)));
    });
    return kPointWeight * sum;
}

float SdTreeInspector::probability(std::int32_t volume, int cell) const {
    float sum = 0.0f;
    for_each_point_of(field.cells, cell, [&](Vec2f square) { sum += density(volume, square); });
    return kPointWeight * sum / static_cast<float>(field.cells.count());
}

std::uint32_t SdTreeInspector::samples(std::int32_t volume, int cell) const {
    return spread_samples(field.samples[static_cast<std::uint32_t>(volume)], probability(volume, cell));
}

float SdTreeInspector::density(std::int32_t volume, Vec2f square) const {
    const Vec3f local = square_to_cosine_hemisphere(square);
    const float cosine = std::max(local.z, 1.0e-4f);  // of the outermost points: rounding noise below
    return field.direction_pdf_sa(leaf_of(volume), field.frame(volume).to_world(local)) * kPi / cosine;
}

float LobeInspector::radiance(std::int32_t volume, int cell) const {
    const auto index = static_cast<std::uint32_t>(volume);
    float sum = 0.0f;
    for_each_point_of(field.cells, cell, [&](Vec2f square) {
        sum += field.radiance_pdf_sa(index, Vec3f{0.0f}, square_to_cosine_hemisphere(square));
    });
    return kPointWeight * sum * field.total[index];
}

float LobeInspector::probability(std::int32_t volume, int cell) const {
    const LobeMixture mixture = mixture_of(volume);
    float sum = 0.0f;
    for_each_point_of(field.cells, cell,
                      [&](Vec2f square) { sum += relative_density(mixture, square_to_cosine_hemisphere(square)); });
    return kPointWeight * sum / static_cast<float>(field.cells.count());
}

std::uint32_t LobeInspector::samples(std::int32_t volume, int cell) const {
    return spread_samples(field.samples[static_cast<std::uint32_t>(volume)], probability(volume, cell));
}

float LobeInspector::density(std::int32_t volume, Vec2f square) const {
    return relative_density(mixture_of(volume), square_to_cosine_hemisphere(square));
}

const VertexMixture& NeuralInspector::mixture_of(std::int32_t volume) const {
    if (mixture_volume_ != volume) mixture_ = mixture_of_volume(mixtures, static_cast<std::uint32_t>(volume));
    mixture_volume_ = volume;
    return mixture_;
}

float NeuralInspector::probability(std::int32_t volume, int cell) const {
    float sum = 0.0f;
    for_each_point_of(mixtures.cells, cell, [&](Vec2f square) { sum += density(volume, square); });
    return kPointWeight * sum / static_cast<float>(mixtures.cells.count());
}

float NeuralInspector::density(std::int32_t volume, Vec2f square) const {
    return relative_density(mixtures, static_cast<std::uint32_t>(volume), mixture_of(volume),
                            square_to_cosine_hemisphere(square));
}

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
