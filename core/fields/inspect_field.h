// Inspection of a learned field on the host: its hemisphere at one volume, for any representation.
#pragma once

#include <concepts>
#include <vector>

#include "core/fields/field_model.h"

namespace pl {

/// A field read in single directions. `cell` is one of cells(), the division of a volume's hemisphere that suits the
/// representation best: for a table, its own cells.
template <class Inspector>
concept FieldInspector = requires(const Inspector& inspector, std::int32_t volume, int cell) {
    { inspector.cells() } -> std::same_as<DirectionCells>;
    { inspector.radiance(volume, cell) } -> std::same_as<float>;         ///< learned incident radiance, luminance
    { inspector.probability(volume, cell) } -> std::same_as<float>;      ///< of sampling a direction of the cell
    { inspector.samples(volume, cell) } -> std::same_as<std::uint32_t>;  ///< training samples
    { inspector.mean_radiance(volume) } -> std::same_as<float>;          ///< irradiance / pi, luminance
};

struct TableInspector {
    TableField field;

    DirectionCells cells() const { return field.cells; }
    float radiance(std::int32_t volume, int cell) const { return field.radiance[field.cell_index(volume, cell)]; }
    float probability(std::int32_t volume, int cell) const {
        const DirectionTable table(field, volume);
        return table.cell_probability(cell % field.cells.side, cell / field.cells.side);
    }
    std::uint32_t samples(std::int32_t volume, int cell) const {
        return field.visits[field.cell_index(volume, cell)];
    }
    float mean_radiance(std::int32_t volume) const { return field.mean_radiance[static_cast<std::uint32_t>(volume)]; }
};
static_assert(FieldInspector<TableInspector>);

inline TableInspector inspector_of(const TableField& field) { return {field}; }

/// The learned hemisphere of one volume. Arrays: [cell] of side x side DirectionCells.
struct VolumeInspection {
    std::int32_t volume = kNoVolume;
    Vec3f position{0.0f};
    Vec3f normal{0.0f, 0.0f, 1.0f};
    int side = 0;
    std::vector<float> radiance;     ///< learned incident radiance Q, luminance
    std::vector<float> probability;  ///< of sampling the cell
    std::vector<std::uint32_t> visits;
    float mean_radiance = 0.0f;  ///< irradiance / pi
};

/// `volume` exists in the field.
VolumeInspection inspect_volume(const AnyFieldView& field, std::int32_t volume);

}  // namespace pl
