// What a representation of a guiding field is on the host: one FieldModel each, asked a few times per pass. Kernels take the views that
// it gives them.
#pragma once

#include <optional>
#include <string>

#include "core/base/choice.h"
#include "core/fields/field_arrays.h"
#include "core/fields/placement_storage.h"
#include "core/kernel/guiding/table_field.h"
#include "core/kernel/inspect/heat_map.h"

namespace pl {

/// Arrays whose values do not go together: "`what`: expected `expected`, got `got`".
struct FieldDamage {
    std::string what, expected, got;
};

/// State of a network, as a session tells it.
struct NetworkStatus {
    std::uint64_t steps = 0;  ///< of gradient descent
    bool is_lost = false;     ///< see kNetworkIsLost
};

/// What is told of a field without its arrays.
struct FieldReport {
    std::size_t bytes = 0;                   ///< of its arrays
    std::optional<NetworkStatus> network{};  ///< of a neural field
};

/// A field read in single directions. `cell` is one of the view's cells, of a volume's hemisphere.
template <class Inspector>
concept FieldInspector = requires(const Inspector& inspector, std::uint32_t volume, int cell) {
    /// Learned incident radiance, rms() of its channels.
    { inspector.radiance(volume, cell) } -> std::same_as<float>;
    { inspector.probability(volume, cell) } -> std::same_as<float>;      ///< of sampling a direction of the cell
    { inspector.samples(volume, cell) } -> std::same_as<std::uint32_t>;  ///< training samples
    /// Density of sampling the direction of a point of the unit square, divided by the density of cosine sampling.
    { inspector.density(volume, Vec2f{}) } -> std::same_as<float>;
    { inspector.bsdf_fraction(volume) } -> std::same_as<float>;  ///< learned
};

/// A representation. Its members are static:
///   kInfo                            ChoiceInfo: its number in files, and what users read of it
///   kGuidance                        time that guiding takes at a vertex, relative to a table
///   kArrays                          SpecList of all arrays, in the order of files
///   Field                            kernel model, a GuidingField
///   Storage<Array>                   its arrays in memory of one kind
///   view(shape, volumes, arrays)     the Field that reads them, in memory of any kind
///   summary(shape, volumes, arrays)  a VolumeSummary: what views show
///   inspector(field)                 a FieldInspector
///   text(shape, arrays)              its directions in words: "256 directions"
/// and, as far as it has them:
///   update(shape, volumes, arrays, threads)  absorbs all pending sums on the host. The same bits for any number of threads. Without it
///                                            back ends have kernels of their own
///   split(shape, arrays, parents)            the arrays of a refined placement; else split_arrays()
///   forget(shape, volumes, arrays, volume)   one volume begins anew; else reset_volume()
///   damage(arrays)                           optional FieldDamage of arrays that fit, each of whose values is valid
///   network(arrays)                          NetworkStatus
///   kBytesBesideVolumes                      of arrays that no volume owns
///   bytes_of_node(), kMostNodes              of trees, which share what volumes leave of the budget
template <class Model>
concept FieldModel = GuidingField<typename Model::Field> &&
    FieldStorage<typename Model::template Storage<LargeArray>> &&
    requires(const FieldShape& shape, const HostVolumes& volumes,
             typename Model::template Storage<LargeArray>& arrays, const typename Model::Field& field) {
    { Model::kInfo } -> std::same_as<const ChoiceInfo<Representation>&>;
    { Model::kGuidance } -> std::convertible_to<double>;
    { Model::view(shape, volumes, arrays) } -> std::same_as<typename Model::Field>;
    { Model::summary(shape, volumes, arrays) } -> VolumeSummary;
    { Model::inspector(field) } -> FieldInspector;
    { Model::text(shape, arrays) } -> std::same_as<std::string>;
};

/// What every view with one hemisphere per radiance volume takes from the shape of its field.
inline void set_common(const FieldShape& shape, const PlacementView& placement, FieldView& view) {
    static_cast<PlacementView&>(view) = placement;
    view.cells = shape.cells;
    view.light_clusters = shape.light_clusters;
    view.radiance_unit = shape.radiance_unit;
}

/// The functions of FieldModel, by the storage of a representation.
template <template <class> class Array, FieldStorage Storage>
auto field_view(const FieldShape& shape, const VolumeStorage<Array>& volumes, Storage& arrays) {
    return ModelOf<Storage>::view(shape, volumes, arrays);
}
template <FieldStorage Storage>
VolumeSummary auto summary_of(const FieldShape& shape, const HostVolumes& volumes, Storage& arrays) {
    return ModelOf<Storage>::summary(shape, volumes, arrays);
}
template <FieldStorage Storage>
Storage split_field(const FieldShape& shape, Storage arrays, std::span<const std::uint32_t> parents) {
    if constexpr (requires { ModelOf<Storage>::split(shape, arrays, parents); })
        return ModelOf<Storage>::split(shape, std::move(arrays), parents);
    else
        return split_arrays(shape, std::move(arrays), parents);
}
template <FieldStorage Storage>
void forget_volume(const FieldShape& shape, const HostVolumes& volumes, Storage& arrays, std::size_t volume) {
    if constexpr (requires { ModelOf<Storage>::forget(shape, volumes, arrays, volume); })
        ModelOf<Storage>::forget(shape, volumes, arrays, volume);
    else
        reset_volume(shape, arrays, volume);
}
template <FieldStorage Storage>
std::optional<FieldDamage> damage_of(const Storage& arrays) {
    if constexpr (requires { ModelOf<Storage>::damage(arrays); })
        return ModelOf<Storage>::damage(arrays);
    else
        return std::nullopt;
}
template <FieldStorage Storage>
FieldReport report_of(const Storage& arrays) {
    FieldReport report{.bytes = field_bytes(arrays)};
    if constexpr (requires { ModelOf<Storage>::network(arrays); }) report.network = ModelOf<Storage>::network(arrays);
    return report;
}

// --- for models and inspectors ---------------------------------------------------------------------------------------------------

/// Points per side of a cell at which densities are taken.
inline constexpr int kFinePoints = 4;

/// Mean of value(point) over the middles of the kFinePoints x kFinePoints parts of a cell.
template <class Value>
float mean_of_cell(const DirectionCells& cells, int cell, const Value& value) {
    float sum = 0.0f;
    for (int row = 0; row < kFinePoints; ++row)
        for (int column = 0; column < kFinePoints; ++column)
            sum += value(cells.point_in_cell(cell, (Vec2f{column, row} + 0.5f) / static_cast<float>(kFinePoints)));
    return sum / static_cast<float>(kFinePoints * kFinePoints);
}

/// The samples of a volume that fall to a cell of this probability.
inline std::uint32_t spread_samples(std::uint32_t all, float probability) {
    return static_cast<std::uint32_t>(all * std::min(1.0, static_cast<double>(probability)));
}

/// The part of a VolumeSummary that VolumeIrradiance tells.
template <class Field>
struct IrradianceSummary {
    Field field;

    float samples(std::uint32_t volume) const { return static_cast<float>(field.samples[volume]); }
    float mean_radiance(std::uint32_t volume) const { return field.mean_radiance[volume] + field.direct[volume]; }
    float change(std::uint32_t volume) const { return field.change[volume]; }
};

/// A density divided by the density of cosine sampling. `local`: its direction in the frame of the normal.
inline float relative_to_cosine(float pdf_sa, Vec3f local) {
    const float cosine = max_of(local.z, 1.0e-4f);  // of the outermost points: rounding noise below
    return pdf_sa * kPi / cosine;
}

/// Calls visit(density(direction in the middle)) for the cells of a hemisphere.
template <class Density, class Visit>
void for_each_cell_density(const DirectionCells& cells, const Density& density, Visit&& visit) {
    for (int cell = 0; cell < cells.count(); ++cell)
        visit(density(square_to_cosine_hemisphere(cells.point_in_cell(cell, Vec2f{0.5f}))));
}

/// Entropy of the cells of a hemisphere, bits, by their relative densities.
template <class Density>
float entropy_of_cells(const DirectionCells& cells, const Density& density) {
    float total = 0.0f;
    for_each_cell_density(cells, density, [&](float value) { total += value; });
    float bits = 0.0f;
    for_each_cell_density(cells, density, [&](float value) {
        const float p = value / total;
        if (p > 0.0f) bits -= p * std::log2(p);
    });
    return bits;
}

}  // namespace pl
