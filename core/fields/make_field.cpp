#include "core/fields/make_field.h"

#include <algorithm>
#include <cmath>

#include "core/fields/volume_grid.h"
#include "core/scene/pack_scene.h"

namespace pl {
namespace {

constexpr double kBytesPerMegabyte = 1.0e6;

int side_of(int bins) { return static_cast<int>(std::lround(std::sqrt(static_cast<double>(bins)))); }

/// Volumes that the budget holds.
double affordable(const FieldSettings& settings) {
    return settings.budget_megabytes * kBytesPerMegabyte / static_cast<double>(bytes_per_volume(settings.bins));
}

/// Smallest power of two not below `value`, kept where neither dividing by it nor kMaxRecordedUnits times it can
/// leave the range of float.
float power_of_two_above(float value) {
    constexpr int kMaxExponent = 100;
    if (!(value > 0.0f)) return 1.0f;
    int exponent = 0;
    const float mantissa = std::frexp(value, &exponent);  // in [0.5, 1)
    if (mantissa == 0.5f) --exponent;
    return std::ldexp(1.0f, std::clamp(exponent, -kMaxExponent, kMaxExponent));
}

template <class Storage>
std::size_t bytes_of_all(const Storage& storage) {
    std::size_t bytes = 0;
    zip(storage, storage, [&](const auto& array, const auto&) { bytes += array.size() * sizeof array[0]; });
    return bytes;
}

}  // namespace

std::size_t table_bytes(int bins) {
    const std::size_t per_cell = 2 * sizeof(float) + 2 * sizeof(std::uint32_t) + sizeof(std::int64_t);
    const std::size_t rows = static_cast<std::size_t>(side_of(bins)) * sizeof(float);
    const std::size_t per_volume = 8 * sizeof(float) + 4 * sizeof(std::int64_t);
    return rows + per_volume + static_cast<std::size_t>(bins) * per_cell;
}

std::size_t bytes_per_volume(int bins) {
    return sizeof(SurfacePoint) + sizeof(Vec3f) + sizeof(KdNode) + kGridBytesPerVolume + table_bytes(bins);
}

int volume_count(const FieldSettings& settings) {
    if (settings.volumes > 0) return settings.volumes;
    return std::max(1, static_cast<int>(std::min(affordable(settings), static_cast<double>(kDefaultVolumes))));
}

std::size_t most_refined_volumes(const FieldSettings& settings, std::size_t placed) {
    const bool is_budgeted = settings.volumes == 0;
    double share = settings.refine_share;
    if (settings.refine_share == kRefineByRecords) share = is_budgeted ? 1.0 : 0.0;
    double most = std::floor((1.0 + share) * static_cast<double>(placed));
    if (is_budgeted) most = std::min(most, std::floor(affordable(settings)));
    return std::max(placed, static_cast<std::size_t>(most));
}

FieldShape make_field_shape(const HostScene& scene, const FieldSettings& settings) {
    float brightest = luminance(scene.environment);
    for (const Vec3f& texel : scene.map_texels) brightest = std::max(brightest, luminance(texel));
    // A sun is so small and bright that the light of all else would be lost in its roundings: its mean over half of the sky
    // leaves room for both.
    const Sun& sun = scene.far_lights.sun;
    brightest = std::max(brightest, luminance(sun.radiance) * 0.5f * sun.chord2);
    for (const Light& light : scene.lights) {
        const Material& material = scene.materials[scene.triangles[light.primitive].material];
        brightest = std::max(brightest, luminance(material.emission));
    }
    return {.cells = {side_of(settings.bins)},
            .radiance_unit = power_of_two_above(brightest),
            .extent = bounds_of(scene).diagonal(),
            .rate = settings.rate,
            .uniform_floor = settings.uniform_floor,
            .lookup = settings.lookup};
}

HostTables make_tables(const FieldShape& shape, std::size_t volumes) {
    const auto side = static_cast<std::size_t>(shape.cells.side);
    const std::size_t cells = volumes * side * side;
    HostTables tables;
    tables.radiance.assign(cells, 0.0f);
    tables.visits.assign(cells, 0);
    tables.pending_sum.assign(cells, 0);
    tables.pending_count.assign(cells, 0);
    tables.row_cdf.resize(volumes * side);
    tables.column_cdf.resize(cells);
    tables.mean_radiance.assign(volumes, 0.0f);
    tables.change.assign(volumes, 0.0f);
    tables.pending_slope.assign(volumes, 0);
    tables.pending_curvature.assign(volumes, 0);
    tables.mixture_target.assign(volumes, 0.0f);
    tables.mixture_weight.assign(volumes, 0.0f);
    tables.bsdf_fraction.assign(volumes, kInitialBsdfFraction);
    tables.pending_distance.assign(volumes, 0);
    tables.pending_light.assign(volumes, 0);
    tables.reach_distance.assign(volumes, 0.0f);
    tables.reach_weight.assign(volumes, 0.0f);
    tables.inverse_reach.assign(volumes, inverse_reach_of(shape.extent, kUnknownDistance));
    const auto uniform = [side](std::size_t i) {
        return static_cast<float>(i % side + 1) / static_cast<float>(side);
    };
    for (std::size_t i = 0; i < tables.row_cdf.size(); ++i) tables.row_cdf[i] = uniform(i);
    for (std::size_t i = 0; i < tables.column_cdf.size(); ++i) tables.column_cdf[i] = uniform(i);
    return tables;
}

std::size_t volume_bytes(const HostVolumes& volumes) { return bytes_of_all(volumes); }

std::size_t field_bytes(const HostVolumes& volumes, const HostTables& tables) {
    return bytes_of_all(volumes) + bytes_of_all(tables);
}

}  // namespace pl
