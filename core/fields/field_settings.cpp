#include "core/fields/field_settings.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/memory.h"
#include "core/fields/field_model.h"
#include "core/fields/volume_grid.h"
#include "core/scene/pack_scene.h"

namespace pl {
namespace {

constexpr double kBytesPerMegabyte = 1.0e6;

int side_of(int bins) { return static_cast<int>(std::lround(std::sqrt(static_cast<double>(bins)))); }

/// Bytes of placement, tree and grid of a volume.
constexpr std::size_t kPlacementBytes = sizeof(SurfacePoint) + sizeof(Vec3f) + sizeof(KdNode) + kGridBytesPerVolume;

FieldShape shape_of(const FieldSettings& settings, std::size_t light_clusters) {
    return {.cells = {side_of(settings.bins)}, .light_clusters = static_cast<std::uint32_t>(light_clusters)};
}

/// Bytes of a volume. The methods of a session share its placement, so that it holds tables, too.
std::size_t bytes_of_each(const FieldSettings& settings, std::size_t light_clusters) {
    std::size_t bytes = table_bytes(settings.bins, light_clusters);
    with_model(settings.representation, [&]<class Model>() {
        using Storage = typename Model::template Storage<LargeArray>;
        bytes = std::max(bytes, bytes_by_volume<Storage>(shape_of(settings, light_clusters)));
    });
    return kPlacementBytes + bytes;
}

/// Bytes of the arrays of a field that are the same for any number of volumes.
std::size_t bytes_beside_volumes(const FieldSettings& settings) {
    std::size_t bytes = 0;
    with_model(settings.representation, [&]<class Model>() {
        if constexpr (requires { Model::kBytesBesideVolumes; }) bytes = Model::kBytesBesideVolumes;
    });
    return bytes;
}

/// Number of volumes within the budget.
double affordable(const FieldSettings& settings, std::size_t light_clusters) {
    const double left =
        settings.budget_megabytes * kBytesPerMegabyte - static_cast<double>(bytes_beside_volumes(settings));
    return std::max(left, 0.0) / static_cast<double>(bytes_of_each(settings, light_clusters));
}

/// Nodes of a representation of trees within the budget, which its volumes share.
template <class Model>
std::uint32_t affordable_nodes(const FieldSettings& settings, std::size_t light_clusters) {
    using Storage = typename Model::template Storage<LargeArray>;
    const std::size_t per_volume = kPlacementBytes + bytes_by_volume<Storage>(shape_of(settings, light_clusters));
    const double volumes = static_cast<double>(per_volume) * volume_count(settings, light_clusters);
    const double left = settings.budget_megabytes * kBytesPerMegabyte - volumes;
    const double nodes = left / static_cast<double>(Model::bytes_of_node());
    return static_cast<std::uint32_t>(std::clamp(nodes, 64.0, static_cast<double>(Model::kMostNodes)));
}

/// Nodes of the representation of trees, whatever the settings choose: a shape is told in full.
std::uint32_t nodes_of_shape(const FieldSettings& settings, std::size_t light_clusters) {
    std::uint32_t nodes = 1;
    any_of_types(FieldModels{}, [&]<class Model>() {
        if constexpr (requires { Model::kMostNodes; }) nodes = affordable_nodes<Model>(settings, light_clusters);
        return requires { Model::kMostNodes; };
    });
    return nodes;
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

/// Irradiance / pi by the brightest of the delta lights, of points and spots at this share of the scene's diagonal: closer surfaces are so
/// small that their light adds little.
float brightest_by_delta_lights(const HostScene& scene, float diagonal) {
    constexpr float kNearShare = 0.05f;
    const float distance = kNearShare * diagonal;
    float brightest = 0.0f;
    for (const DeltaLight& light : scene.delta_lights) {
        const bool is_far = light.kind == DeltaLightKind::Directional || !(distance > 0.0f);
        const float irradiance = rms(light.intensity) / (is_far ? 1.0f : distance * distance);
        brightest = std::max(brightest, kInvPi * irradiance);
    }
    return brightest;
}

}  // namespace

std::size_t bytes_per_volume(int bins, std::size_t light_clusters) {
    return kPlacementBytes + table_bytes(bins, light_clusters);
}

void require_field_memory(const FieldSettings& settings, std::size_t light_clusters) {
    const int volumes = volume_count(settings, light_clusters);
    std::uint64_t bytes = bytes_beside_volumes(settings) +
                          static_cast<std::uint64_t>(volumes) * bytes_of_each(settings, light_clusters);
    with_model(settings.representation, [&]<class Model>() {
        if constexpr (requires { Model::kMostNodes; })
            bytes += affordable_nodes<Model>(settings, light_clusters) * Model::bytes_of_node();
    });
    require_memory(fmt::format("{} radiance volumes of {} directions", volumes, settings.bins), 0, ErrorKind::Usage,
                   bytes);
}

int volume_count(const FieldSettings& settings, std::size_t light_clusters) {
    if (settings.volumes > 0) return settings.volumes;
    return std::max(
        1, static_cast<int>(std::min(affordable(settings, light_clusters), static_cast<double>(kDefaultVolumes))));
}

std::size_t most_refined_volumes(const FieldSettings& settings, std::size_t placed, std::size_t light_clusters) {
    const bool is_budgeted = settings.volumes == 0;
    double share = settings.refine_share;
    if (settings.refine_share == kRefineByRecords) share = is_budgeted ? 1.0 : 0.0;
    double most = std::floor((1.0 + share) * static_cast<double>(placed));
    if (is_budgeted) most = std::min(most, std::floor(affordable(settings, light_clusters)));
    return std::max(placed, static_cast<std::size_t>(most));
}

FieldShape make_field_shape(const HostScene& scene, const FieldSettings& settings) {
    float brightest = rms(scene.environment);
    for (const MapTexel& texel : scene.map_texels) brightest = std::max(brightest, rms(texel.radiance));
    // A sun is so small and bright that fixed-point steps of its radiance would lose all other light: its mean over half of the
    // sky resolves both.
    const Sun& sun = scene.far_lights.sun;
    brightest = std::max(brightest, rms(sun.radiance) * 0.5f * sun.chord2);
    for (const Light& light : scene.lights) {
        const Material& material = scene.materials[scene.triangles[light.primitive].material];
        brightest = std::max(brightest, rms(material.emission));
    }
    const Bounds bounds = bounds_of(scene);
    brightest = std::max(brightest, brightest_by_delta_lights(scene, bounds.diagonal()));
    const auto light_clusters = static_cast<std::uint32_t>(scene.light_clusters.size());
    const float edge = bounds.empty() ? 0.0f : max_component(bounds.high - bounds.low);
    return {.cells = {side_of(settings.bins)},
            .light_clusters = light_clusters,
            .radiance_unit = power_of_two_above(brightest),
            .extent = bounds.diagonal(),
            .rate = settings.rate,
            .uniform_floor = settings.uniform_floor,
            .representation = settings.representation,
            .corner = bounds.empty() ? Vec3f{0.0f} : bounds.low,
            .edge = edge > 0.0f && edge < kInfinity ? edge : 1.0f,
            .most_nodes = nodes_of_shape(settings, light_clusters)};
}

std::size_t volume_bytes(const HostVolumes& volumes) {
    std::size_t bytes = 0;
    zip(volumes, volumes, [&](const auto& array, const auto&) { bytes += array.size() * sizeof array[0]; });
    return bytes;
}

}  // namespace pl
