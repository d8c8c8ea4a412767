// Mixtures of lobes as a model of a guiding field on the host: the one description of their arrays, and all code derived from it.
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "core/fields/table_model.h"
#include "core/kernel/guiding/lobe_field.h"

namespace pl {

template <template <class> class Array>
using LobeStorage = LobeArrays<Array, Array>;
using HostLobes = LobeStorage<LargeArray>;

/// The owners of an array's values.
enum class LobeExtent { Lobe, LobeAxis, LobeStatistic, Volume, LightCluster };

/// Description of one array of LobeArrays.
template <class Get>
struct LobeSpec {
    const char* name;    ///< plural, in messages
    const char* single;  ///< of one value, in messages
    LobeExtent extent;
    OnSplit on_split;  ///< of a radiance volume
    ValidRange valid;
    float (*initial)(std::size_t i);  ///< value i of a volume without training samples
    Get get;                          ///< the array of any LobeArrays
};
template <class Get>
LobeSpec(const char*, const char*, LobeExtent, OnSplit, ValidRange, float (*)(std::size_t), Get) -> LobeSpec<Get>;

/// Concentration of the lobes of a fresh mixture, spread evenly over the hemisphere: their sum is nearly uniform on it.
inline constexpr float kFirstKappa = 5.0f;
/// Component i of their means, three for each: on a spiral.   [Fibonacci lattice]
float first_mean(std::size_t i);

namespace lobe_arrays {

using enum LobeExtent;
using enum OnSplit;
using enum ValidRange;

inline float none(std::size_t) { return 0.0f; }
inline float first_count(std::size_t) { return kFirstLobes; }
inline float first_weight(std::size_t i) { return i < kFirstLobes ? 1.0f / kFirstLobes : 0.0f; }
inline float first_kappa(std::size_t i) { return i < kFirstLobes ? kFirstKappa : 0.0f; }
inline float first_fraction(std::size_t) { return kInitialBsdfFraction; }

/// The arrays in the order of files.
// clang-format off
inline constexpr SpecList kAll{
    LobeSpec{"numbers of lobes", "number of lobes", Volume, Copy, Any, first_count, [](auto& t) -> auto& { return t.lobe_count; }},
    LobeSpec{"weights of lobes", "weight of a lobe", Lobe, Copy, Amount, first_weight, [](auto& t) -> auto& { return t.weight; }},
    LobeSpec{"means of lobes", "mean of a lobe", LobeAxis, Copy, Finite, first_mean, [](auto& t) -> auto& { return t.mean; }},
    LobeSpec{"concentrations", "concentration", Lobe, Copy, Amount, first_kappa, [](auto& t) -> auto& { return t.kappa; }},
    LobeSpec{"inverse distances", "inverse distance", Lobe, Copy, Amount, none, [](auto& t) -> auto& { return t.inverse_distance; }},
    LobeSpec{"moments", "moment", LobeStatistic, Copy, Finite, none, [](auto& t) -> auto& { return t.moments; }},
    LobeSpec{"ages", "age", Lobe, Copy, Any, none, [](auto& t) -> auto& { return t.age; }},
    LobeSpec{"totals", "total", Volume, Copy, Amount, none, [](auto& t) -> auto& { return t.total; }},
    LobeSpec{"sums of moments", "sum of a moment", LobeStatistic, Clear, Any, none, [](auto& t) -> auto& { return t.pending_moments; }},
    LobeSpec{"slopes of the mixture", "slope of the mixture", Volume, Clear, Any, none, [](auto& t) -> auto& { return t.pending_slope; }},
    LobeSpec{"curvatures of the mixture", "curvature of the mixture", Volume, Clear, NotNegative, none, [](auto& t) -> auto& { return t.pending_curvature; }},
    LobeSpec{"targets of the mixture", "target of the mixture", Volume, Halve, Finite, none, [](auto& t) -> auto& { return t.mixture_target; }},
    LobeSpec{"weights of the mixture", "weight of the mixture", Volume, Halve, Amount, none, [](auto& t) -> auto& { return t.mixture_weight; }},
    LobeSpec{"BSDF shares", "BSDF share", Volume, Copy, BsdfFraction, first_fraction, [](auto& t) -> auto& { return t.bsdf_fraction; }},
    LobeSpec{"mean radiance", "mean radiance", Volume, Copy, Amount, none, [](auto& t) -> auto& { return t.mean_radiance; }},
    LobeSpec{"samples", "samples", Volume, Divide, Any, none, [](auto& t) -> auto& { return t.samples; }},
    LobeSpec{"sums of values", "sum of values", Volume, Clear, NotNegative, none, [](auto& t) -> auto& { return t.pending_value; }},
    LobeSpec{"sums of weights", "sum of weights", Volume, Clear, NotNegative, none, [](auto& t) -> auto& { return t.pending_weight; }},
    LobeSpec{"new samples", "new samples", Volume, Clear, Any, none, [](auto& t) -> auto& { return t.pending_samples; }},
    LobeSpec{"changes", "change", Volume, Copy, Amount, none, [](auto& t) -> auto& { return t.change; }},
    LobeSpec{"sums of direct light", "sum of direct light", Volume, Clear, NotNegative, none, [](auto& t) -> auto& { return t.pending_direct; }},
    LobeSpec{"counts of light samples", "count of light samples", Volume, Clear, Any, none, [](auto& t) -> auto& { return t.pending_direct_count; }},
    LobeSpec{"direct light", "direct light", Volume, Copy, Amount, none, [](auto& t) -> auto& { return t.direct; }},
    LobeSpec{"light samples", "light samples", Volume, Divide, Any, none, [](auto& t) -> auto& { return t.direct_count; }},
    LobeSpec{"sums of light by clusters", "sum of light by a cluster", LightCluster, Clear, NotNegative, none, [](auto& t) -> auto& { return t.pending_cluster; }},
    LobeSpec{"light by clusters", "light by a cluster", LightCluster, Copy, Amount, none, [](auto& t) -> auto& { return t.cluster_light; }},
    LobeSpec{"choices of lights", "choice of lights", LightCluster, Copy, Choice, none, [](auto& t) -> auto& { return t.light_cdf; }},
};
// clang-format on

}  // namespace lobe_arrays

/// Calls fn(spec) for every array.
template <class Fn>
constexpr void for_each_lobe_array(Fn&& fn) {
    for_each_spec(lobe_arrays::kAll, fn);
}

/// Calls fn(array of `from`, array of `to`) for every array; `to` is const if fn only reads it.
template <template <class> class From, class To, class Fn>
void zip(const LobeArrays<From, From>& from, To& to, Fn&& fn) {
    for_each_lobe_array([&](const auto& spec) { fn(spec.get(from), spec.get(to)); });
}

/// Number of values of an array for this number of volumes.
std::size_t extent_of(LobeExtent extent, const FieldShape& shape, std::size_t volumes);

/// Mixtures without training samples.
HostLobes make_lobes(const FieldShape& shape, std::size_t volumes);
/// Gives one volume the values of a mixture without training samples.
void reset_lobes(const FieldShape& shape, HostLobes& lobes, std::size_t volume);

/// Whether all arrays have the lengths that follow from the shape and the number of volumes.
bool fits(const FieldShape& shape, const HostLobes& lobes, std::size_t volumes);
std::size_t field_bytes(const HostLobes& lobes);
inline std::size_t volume_count(const HostLobes& lobes) { return lobes.mean_radiance.size(); }

/// Bytes of all arrays for each volume. `light_clusters`: of the scene's light tree.
std::size_t lobe_bytes(std::size_t light_clusters = 0);

/// New volumes begin with the mixtures of their parents.
HostLobes split_field(const FieldShape& shape, HostLobes lobes, std::span<const std::uint32_t> parents);

/// The damage of mixtures whose arrays fit: no lobe, too many, weights that do not add up to 1, means that are no directions, or
/// concentrations and distances out of range. Empty if there is none: then densities are finite and those of samples.
std::optional<std::string> damage_of(const HostLobes& lobes);

template <template <class> class Array, template <class> class LobeArray>
LobeField field_view(const FieldShape& shape, const VolumeStorage<Array>& volumes, LobeStorage<LobeArray>& lobes) {
    LobeField field;
    static_cast<PlacementView&>(field) = placement_view(volumes, shape.extent);
    field.cells = shape.cells;
    field.light_clusters = shape.light_clusters;
    field.radiance_unit = shape.radiance_unit;
    for_each_lobe_array([&](const auto& spec) { spec.get(field) = view_of(spec.get(lobes)); });
    return field;
}

/// A density relative to that of cosine sampling. `local`: its direction in the frame of the normal.
inline float relative_to_cosine(float pdf_sa, Vec3f local) {
    const float cosine = max_of(local.z, 1.0e-4f);  // of the outermost points: rounding noise below
    return pdf_sa * kPi / cosine;
}

/// Density of a mixture in a direction of a volume's hemisphere, as its site samples it, relative to that of cosine sampling. `local`
/// in the frame of the normal.
float relative_density(const LobeMixture& mixture, Vec3f local);

/// Calls visit(density(direction in the middle)) for the cells of a hemisphere.
template <class Density, class Visit>
void for_each_cell_density(const DirectionCells& cells, const Density& density, Visit&& visit) {
    for (int cell = 0; cell < cells.count(); ++cell)
        visit(density(square_to_cosine_hemisphere(cells.point_in_cell(cell, Vec2f{0.5f}))));
}

/// Of the cells of a hemisphere, bits, by their relative densities.
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

/// VolumeSummary of mixtures.
struct LobeVolumeSummary {
    LobeField field;

    float samples(std::uint32_t volume) const { return static_cast<float>(field.samples[volume]); }
    /// Share of the hemisphere with less than a hundredth of the density of cosine sampling; 1 before any training sample.
    float unvisited_share(std::uint32_t volume) const;
    /// Of the mixture over as many cells of the hemisphere as tables have.
    float entropy(std::uint32_t volume) const;
    float mean_radiance(std::uint32_t volume) const { return field.mean_radiance[volume] + field.direct[volume]; }
    float change(std::uint32_t volume) const { return field.change[volume]; }
    float bsdf_fraction(std::uint32_t volume) const { return field.bsdf_fraction[volume]; }
};
static_assert(VolumeSummary<LobeVolumeSummary>);

template <template <class> class Array>
LobeVolumeSummary summary_of(const FieldShape& shape, const HostVolumes& volumes, LobeStorage<Array>& lobes) {
    return {field_view(shape, volumes, lobes)};
}

}  // namespace pl
