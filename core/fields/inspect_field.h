// Inspection of a learned field on the host: its hemisphere at one volume, for any representation.
#pragma once

#include <concepts>
#include <span>
#include <vector>

#include "core/fields/field_model.h"

namespace pl {

/// A field read in single directions. `cell` is one of cells(), the division of a volume's hemisphere that suits the
/// representation best: for a table, its own cells.
template <class Inspector>
concept FieldInspector = requires(const Inspector& inspector, std::int32_t volume, int cell) {
    { inspector.cells() } -> std::same_as<DirectionCells>;
    /// Learned incident radiance, rms() of its channels.
    { inspector.radiance(volume, cell) } -> std::same_as<float>;
    { inspector.probability(volume, cell) } -> std::same_as<float>;      ///< of sampling a direction of the cell
    { inspector.samples(volume, cell) } -> std::same_as<std::uint32_t>;  ///< training samples
    { inspector.mean_radiance(volume) } -> std::same_as<float>;          ///< rms() of irradiance / pi
    /// Density of sampling the direction of a point of the unit square, relative to that of cosine sampling.
    { inspector.density(volume, Vec2f{}) } -> std::same_as<float>;
    { inspector.bsdf_fraction(volume) } -> std::same_as<float>;  ///< learned
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
    float density(std::int32_t volume, Vec2f square) const {
        return square_density<One>(DirectionTable(field, volume), unpack(square));
    }
    float bsdf_fraction(std::int32_t volume) const { return field.bsdf_fraction[static_cast<std::uint32_t>(volume)]; }
};
static_assert(FieldInspector<TableInspector>);

inline TableInspector inspector_of(const TableField& field) { return {field}; }

/// An SD-tree by the cells that tables have. Its samples are those of the volume, spread over the cells by their probability.
struct SdTreeInspector {
    SdTreeField field;

    DirectionCells cells() const { return field.cells; }
    float radiance(std::int32_t volume, int cell) const;
    float probability(std::int32_t volume, int cell) const;
    std::uint32_t samples(std::int32_t volume, int cell) const;
    float mean_radiance(std::int32_t volume) const { return field.mean_radiance[static_cast<std::uint32_t>(volume)]; }
    float density(std::int32_t volume, Vec2f square) const;
    float bsdf_fraction(std::int32_t volume) const { return field.bsdf_fraction[leaf_of(volume)]; }

private:
    std::uint32_t leaf_of(std::int32_t volume) const {
        return SdTreeVolumeSummary{field}.leaf_of(static_cast<std::uint32_t>(volume));
    }
};
static_assert(FieldInspector<SdTreeInspector>);

inline SdTreeInspector inspector_of(const SdTreeField& field) { return {field}; }

/// Mixtures of lobes as the sites of volumes see them, by the cells that tables have; samples as those of an SD-tree.
struct LobeInspector {
    LobeField field;

    DirectionCells cells() const { return field.cells; }
    float radiance(std::int32_t volume, int cell) const;
    float probability(std::int32_t volume, int cell) const;
    std::uint32_t samples(std::int32_t volume, int cell) const;
    float mean_radiance(std::int32_t volume) const { return field.mean_radiance[static_cast<std::uint32_t>(volume)]; }
    float density(std::int32_t volume, Vec2f square) const;
    float bsdf_fraction(std::int32_t volume) const { return field.bsdf_fraction[static_cast<std::uint32_t>(volume)]; }

private:
    LobeMixture mixture_of(std::int32_t volume) const {
        return field.product_at(static_cast<std::uint32_t>(volume), Vec3f{0.0f}, {0.0f, 0.0f, 1.0f});
    }
};
static_assert(FieldInspector<LobeInspector>);

inline LobeInspector inspector_of(const LobeField& field) { return {field}; }

/// The mixtures at the sites of volumes, by the cells of their tables, whose radiance and samples they are taught by.
struct NeuralInspector : TableInspector {
    NeuralField mixtures;

    float probability(std::int32_t volume, int cell) const;
    float density(std::int32_t volume, Vec2f square) const;

private:
    /// Kept for the next direction: the network is asked once for a volume.
    const VertexMixture& mixture_of(std::int32_t volume) const;
    mutable VertexMixture mixture_{};
    mutable std::int32_t mixture_volume_ = kNoVolume;
};
static_assert(FieldInspector<NeuralInspector>);

inline NeuralInspector inspector_of(const NeuralField& field) {
    NeuralInspector inspector;
    inspector.field = inspector.mixtures = field;
    return inspector;
}

/// Points per side of a cell at which densities are taken.
inline constexpr int kFinePoints = 4;

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

}  // namespace pl
