// The cosine lobe as a representation on the host: the example of docs/extending.md.
#pragma once

#include <fmt/format.h>

#include "core/fields/representation.h"
#include "core/fields/volume_irradiance_update.h"
#include "tests/extending/cosine_lobe_field.h"

namespace pl::test {

template <template <class> class Array>
using CosineLobeStorage = CosineLobeArrays<Array, Array>;
using HostCosineLobes = CosineLobeStorage<LargeArray>;

namespace cosine_lobe_arrays {

inline constexpr ArrayOwner kOfAxis{"place", [](const FieldShape&) -> std::size_t { return 3; }};

// clang-format off
inline constexpr auto kAll = SpecList{
    ArraySpec{"directions", "direction", kOfAxis, OnSplit::Copy, ValidRange::Finite, kZero, [](auto& t) -> auto& { return t.direction; }},
    ArraySpec{"sums of directions", "sum of directions", kOfAxis, OnSplit::Clear, ValidRange::Any, kZero, [](auto& t) -> auto& { return t.pending_direction; }},
} + mixture_arrays(kOfVolume) + kIrradianceArrays + kLightArrays;
// clang-format on

}  // namespace cosine_lobe_arrays

/// Density relative to the density of cosine sampling. `local` in the frame of the volume's normal.
inline float relative_density(const CosineLobeField& field, std::uint32_t volume, Vec3f local) {
    const Vec3f wi = field.frame(static_cast<std::int32_t>(volume)).to_world(local);
    return relative_to_cosine(field.lobe_pdf_sa(volume, wi), local);
}

struct CosineLobeInspector : IrradianceSummary<CosineLobeField> {
    using IrradianceSummary<CosineLobeField>::samples;
    float unvisited_share(std::uint32_t volume) const { return samples(volume) > 0.0f ? 0.0f : 1.0f; }
    float entropy(std::uint32_t volume) const {
        return entropy_of_cells(field.cells, [&](Vec3f local) { return relative_density(field, volume, local); });
    }
    float bsdf_fraction(std::uint32_t volume) const { return field.bsdf_fraction[volume]; }

    float radiance(std::uint32_t volume, int cell) const {
        return field.mean_radiance[volume] * relative(volume, cell);
    }
    float probability(std::uint32_t volume, int cell) const {
        return relative(volume, cell) / static_cast<float>(field.cells.count());
    }
    std::uint32_t samples(std::uint32_t volume, int cell) const {
        return spread_samples(field.samples[volume], probability(volume, cell));
    }
    float density(std::uint32_t volume, Vec2f square) const {
        return relative_density(field, volume, square_to_cosine_hemisphere(square));
    }

private:
    float relative(std::uint32_t volume, int cell) const {
        return mean_of_cell(field.cells, cell, [&](Vec2f square) { return density(volume, square); });
    }
};

struct CosineLobeModel;
template <template <class> class Array>
CosineLobeModel model_of(const CosineLobeStorage<Array>&);

struct CosineLobeModel {
    using Field = CosineLobeField;
    template <template <class> class Array>
    using Storage = CosineLobeStorage<Array>;

    static constexpr ChoiceInfo<Representation> kInfo{.value = Representation{100},
                                                      .name = "cosine-lobe",
                                                      .label = "Cosine lobe",
                                                      .sentence =
                                                          "a cosine lobe in each radiance volume, on the CPU alone"};
    static constexpr double kGuidance = 1.0;
    static constexpr const auto& kArrays = cosine_lobe_arrays::kAll;

    template <template <class> class Array, template <class> class LobeArray>
    static CosineLobeField view(const FieldShape& shape, const VolumeStorage<Array>& volumes,
                                CosineLobeStorage<LobeArray>& lobes) {
        CosineLobeField field;
        set_common(shape, placement_view(volumes, shape.extent), field);
        set_arrays(kArrays, field, lobes);
        return field;
    }
    template <template <class> class Array>
    static CosineLobeInspector summary(const FieldShape& shape, const HostVolumes& volumes,
                                       CosineLobeStorage<Array>& lobes) {
        return {view(shape, volumes, lobes)};
    }
    static CosineLobeInspector inspector(const CosineLobeField& field) { return {field}; }
    static std::string text(const FieldShape&, const HostCosineLobes&) { return "one lobe"; }

    static void update(const FieldShape& shape, const HostVolumes&, HostCosineLobes& lobes, int /*threads*/) {
        const VolumeUpdateView view = volume_update_view(shape, lobes);
        for (std::uint32_t volume = 0; volume < volume_count(lobes); ++volume) {
            absorb_volume(view, volume);
            move_mixture(view, volume);
        }
        for (std::size_t i = 0; i < lobes.direction.size(); ++i) {
            lobes.direction[i] += static_cast<float>(lobes.pending_direction[i]) / kStepsPerUnit;
            lobes.pending_direction[i] = 0;
        }
    }
};
static_assert(FieldModel<CosineLobeModel>);

}  // namespace pl::test
