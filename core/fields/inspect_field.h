// Inspection of a learned field on the host: its hemisphere at one volume, for any representation.
#pragma once

#include <span>
#include <vector>

#include "core/fields/field_model.h"

namespace pl {

/// Calls visit(point) for the fine points of the unit square, row by row: the middles of kFinePoints x kFinePoints parts of every
/// cell.
template <class Visit>
void for_each_fine_point(int side, Visit&& visit) {
    const int points = side * kFinePoints;
    for (int row = 0; row < points; ++row)
        for (int column = 0; column < points; ++column)
            visit((Vec2f{column, row} + 0.5f) / static_cast<float>(points));
}

/// Index of the fine point nearest to a point of the unit square.
std::uint32_t fine_cell_of(int side, Vec2f square);

/// Probabilities of the cells, from the density relative to cosine sampling at the fine points.
std::vector<float> cell_shares(int side, std::span<const float> fine_density);

/// The learned hemisphere of one volume. Arrays: [cell] of side x side DirectionCells.
struct VolumeInspection {
    std::int32_t volume = kNoVolume;
    Vec3f position{0.0f};
    Vec3f normal{0.0f, 0.0f, 1.0f};
    SurfacePoint site{};
    int side = 0;
    std::vector<float> radiance;     ///< learned incident radiance Q, rms() of its channels
    std::vector<float> probability;  ///< of sampling the cell
    std::vector<std::uint32_t> visits;
    std::vector<float>
        density;  ///< of sampling the field, relative to cosine sampling. [row][column] of the fine points
    float mean_radiance = 0.0f;  ///< irradiance / pi
    float bsdf_fraction = 0.0f;  ///< of the mixture that guided paths use
};

/// `volume` exists in the field.
VolumeInspection inspect_volume(const AnyFieldView& field, std::int32_t volume);
/// Its probabilities alone, for many volumes. [cell]
std::vector<float> cell_probabilities(const AnyFieldView& field, std::int32_t volume);

}  // namespace pl
