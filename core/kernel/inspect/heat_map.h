// Heat maps of a guiding field: one number per volume, computed once per pass and looked up by pixels.
#pragma once

#include "core/kernel/guiding/direction_table.h"
#include "core/kernel/guiding/table_update.h"
#include "core/kernel/inspect/views.h"

namespace pl {

/// Numbers of one volume of any representation that keeps a hemisphere per volume.
template <class Summary>
concept VolumeSummary = requires(const Summary& summary, std::uint32_t volume) {
    { summary.samples(volume) } -> std::same_as<float>;  ///< training samples
    {
        summary.unvisited_share(volume)
        } -> std::same_as<float>;                              ///< of its directions without training sample, [0, 1]
    { summary.entropy(volume) } -> std::same_as<float>;        ///< of its distribution of directions, bits
    { summary.mean_radiance(volume) } -> std::same_as<float>;  ///< irradiance / pi, rms() of its channels
    { summary.change(volume) } -> std::same_as<float>;         ///< mean change of radiance by the last update
    { summary.bsdf_fraction(volume) } -> std::same_as<float>;  ///< a of the mixture
};

/// VolumeSummary of a table. `field` has all its arrays.
struct TableVolumeSummary {
    TableUpdateView field;

    PL_HD float samples(std::uint32_t volume) const {
        const auto cells = static_cast<std::uint32_t>(field.cells.count());
        std::uint64_t total = 0;
        for (std::uint32_t cell = volume * cells; cell < (volume + 1) * cells; ++cell) total += field.visits[cell];
        return static_cast<float>(total);
    }
    PL_HD float unvisited_share(std::uint32_t volume) const {
        const auto cells = static_cast<std::uint32_t>(field.cells.count());
        float unvisited = 0.0f;
        for (std::uint32_t cell = volume * cells; cell < (volume + 1) * cells; ++cell)
            unvisited += field.visits[cell] == 0 ? 1.0f : 0.0f;
        return unvisited / static_cast<float>(cells);
    }
    /// Entropy of the choice of a cell in bits: 0 for one certain cell, log2(cells) for a uniform table.
    PL_HD float entropy(std::uint32_t volume) const {
        const DirectionTable table(field, static_cast<std::int32_t>(volume));
        float bits = 0.0f;
        for (int row = 0; row < field.cells.side; ++row)
            for (int column = 0; column < field.cells.side; ++column) {
                const float p = table.cell_probability(column, row);
                // Smaller probabilities add less than the resolution of this sum.
                if (p >= std::numeric_limits<float>::min()) bits -= p * log2_normal(p);
            }
        return bits;
    }
    PL_HD float mean_radiance(std::uint32_t volume) const {
        return field.mean_radiance[volume] + field.direct[volume];
    }
    PL_HD float change(std::uint32_t volume) const { return field.change[volume]; }
    PL_HD float bsdf_fraction(std::uint32_t volume) const { return field.bsdf_fraction[volume]; }
};
static_assert(VolumeSummary<TableVolumeSummary>);

/// Change of the last update (the temporal-difference error) relative to the mean radiance; 0 without radiance.
template <VolumeSummary S>
PL_HD inline float relative_change(const S& summary, std::uint32_t volume) {
    const float mean = summary.mean_radiance(volume);
    return mean > 0.0f ? min_of(summary.change(volume) / mean, std::numeric_limits<float>::max()) : 0.0f;
}

/// The number of a volume in a view: not negative, finite; units as in ViewInfo and shown_range(). 0 for numbers that no update
/// can produce (damaged memory), and in views without numbers of volumes.
template <VolumeSummary S>
PL_HD inline float volume_value(const S& summary, std::uint32_t volume, View view) {
    float value = 0.0f;
    switch (view) {
    case View::RadianceMap: return summary.mean_radiance(volume);
    case View::Visits: value = summary.samples(volume); break;
    case View::Irradiance: value = kPi * summary.mean_radiance(volume); break;
    case View::Entropy: value = summary.entropy(volume); break;
    case View::BsdfShare: value = summary.bsdf_fraction(volume); break;
    case View::Change: value = relative_change(summary, volume); break;
    case View::Unvisited: value = summary.unvisited_share(volume); break;
    case View::Beauty:
    case View::Direct:
    case View::Voronoi:
    case View::Normal:
    case View::Albedo:
    case View::Depth: break;
    }
    return value > 0.0f && value < kInfinity ? value : 0.0f;
}

/// Whether a view shows volume_value().
PL_HD constexpr bool needs_volume_values(View view) { return is_heat_map(view) || view == View::RadianceMap; }

}  // namespace pl
