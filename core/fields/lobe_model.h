// Mixtures of lobes as a representation on the host.
#pragma once

#include "core/fields/representation.h"
#include "core/kernel/guiding/lobe_field.h"

namespace pl {

template <template <class> class Array>
using LobeStorage = LobeArrays<Array, Array>;
using HostLobes = LobeStorage<LargeArray>;

/// Concentration of the lobes of a fresh mixture, spread evenly over the hemisphere: their sum is nearly uniform on it.
inline constexpr float kFirstKappa = 5.0f;
/// Component i of their means, three for each: on a spiral.   [Fibonacci lattice]
float first_mean(std::size_t i);

namespace lobe_arrays {

inline constexpr ArrayOwner kOfLobe{"lobe", [](const FieldShape&) { return std::size_t{kMostLobes}; }};
inline constexpr ArrayOwner kOfAxis{"place", [](const FieldShape&) { return std::size_t{kMostLobes} * 3; }};
inline constexpr ArrayOwner kOfMoment{"place",
                                      [](const FieldShape&) { return std::size_t{kMostLobes} * kLobeMoments; }};

inline constexpr auto kFirstCount = [](const FieldShape&, std::size_t) { return kFirstLobes; };
inline constexpr auto kFirstWeight = [](const FieldShape&, std::size_t i) {
    return i < kFirstLobes ? 1.0f / kFirstLobes : 0.0f;
};
inline constexpr auto kFirstMean = [](const FieldShape&, std::size_t i) { return first_mean(i); };
inline constexpr auto kFirstWidth = [](const FieldShape&, std::size_t i) {
    return i < kFirstLobes ? kFirstKappa : 0.0f;
};

using enum OnSplit;
using enum ValidRange;

// clang-format off
inline constexpr auto kAll = SpecList{
    ArraySpec{"numbers of lobes", "number of lobes", kOfVolume, Copy, Any, kFirstCount, [](auto& t) -> auto& { return t.lobe_count; }},
    ArraySpec{"weights of lobes", "weight of a lobe", kOfLobe, Copy, Amount, kFirstWeight, [](auto& t) -> auto& { return t.weight; }},
    ArraySpec{"means of lobes", "mean of a lobe", kOfAxis, Copy, Finite, kFirstMean, [](auto& t) -> auto& { return t.mean; }},
    ArraySpec{"concentrations", "concentration", kOfLobe, Copy, Amount, kFirstWidth, [](auto& t) -> auto& { return t.kappa; }},
    ArraySpec{"inverse distances", "inverse distance", kOfLobe, Copy, Amount, kZero, [](auto& t) -> auto& { return t.inverse_distance; }},
    ArraySpec{"moments", "moment", kOfMoment, Copy, Finite, kZero, [](auto& t) -> auto& { return t.moments; }},
    ArraySpec{"ages", "age", kOfLobe, Copy, Any, kZero, [](auto& t) -> auto& { return t.age; }},
    ArraySpec{"totals", "total", kOfVolume, Copy, Amount, kZero, [](auto& t) -> auto& { return t.total; }},
    ArraySpec{"sums of moments", "sum of a moment", kOfMoment, Clear, Any, kZero, [](auto& t) -> auto& { return t.pending_moments; }},
} + mixture_arrays(kOfVolume) + kIrradianceArrays + kLightArrays;
// clang-format on

}  // namespace lobe_arrays

/// Density of a mixture in a direction of a volume's hemisphere, as the site of the volume samples it, relative to
/// the density of cosine sampling. `local`: the direction in the frame of the normal.
float relative_density(const LobeMixture& mixture, Vec3f local);

/// Mixtures of lobes as the sites of volumes see them; single directions by the cells that tables have.
struct LobeInspector : IrradianceSummary<LobeField> {
    using IrradianceSummary<LobeField>::samples;
    /// Share of the hemisphere with less than a hundredth of the density of cosine sampling; 1 before any training sample.
    float unvisited_share(std::uint32_t volume) const;
    /// Of the mixture over as many cells of the hemisphere as tables have.
    float entropy(std::uint32_t volume) const;
    float bsdf_fraction(std::uint32_t volume) const { return field.bsdf_fraction[volume]; }

    float radiance(std::uint32_t volume, int cell) const;
    float probability(std::uint32_t volume, int cell) const;
    /// The training samples of the volume, spread over the cells by their probability.
    std::uint32_t samples(std::uint32_t volume, int cell) const;
    float density(std::uint32_t volume, Vec2f square) const;

private:
    LobeMixture mixture_of(std::uint32_t volume) const {
        return field.product_at(volume, Vec3f{0.0f}, {0.0f, 0.0f, 1.0f});
    }
};

struct LobeModel {
    using Field = LobeField;
    template <template <class> class Array>
    using Storage = LobeStorage<Array>;

    static constexpr ChoiceInfo<Representation> kInfo{
        .value = Representation::Lobes,
        .name = "lobes",
        .label = "Lobes",
        .sentence = "a mixture of von Mises-Fisher lobes in each radiance volume, on the CPU alone"};
    static constexpr double kGuidance = 9.0;
    static constexpr const auto& kArrays = lobe_arrays::kAll;

    template <template <class> class Array, template <class> class LobeArray>
    static LobeField view(const FieldShape& shape, const VolumeStorage<Array>& volumes,
                          LobeStorage<LobeArray>& lobes) {
        LobeField field;
        set_common(shape, placement_view(volumes, shape.extent), field);
        set_arrays(kArrays, field, lobes);
        return field;
    }
    template <template <class> class Array>
    static LobeInspector summary(const FieldShape& shape, const HostVolumes& volumes, LobeStorage<Array>& lobes) {
        return {view(shape, volumes, lobes)};
    }
    static LobeInspector inspector(const LobeField& field) { return {field}; }
    static std::string text(const FieldShape&, const HostLobes&);

    /// One step of expectation-maximization for each mixture, see mixture_fit.h.
    static void update(const FieldShape& shape, const HostVolumes&, HostLobes& lobes, int threads);
    /// No lobe, too many, weights that do not add up to 1, means that are no directions, or concentrations and distances out of range.
    /// Without damage densities are finite, and samples follow them.
    static std::optional<FieldDamage> damage(const HostLobes& lobes);
};
template <template <class> class Array>
LobeModel model_of(const LobeStorage<Array>&);
static_assert(FieldModel<LobeModel>);

}  // namespace pl
