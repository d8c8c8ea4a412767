#include "core/scene/pack_steps.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include "core/scene/pack_scene.h"

namespace pl {
namespace {

constexpr double kPiExact = 3.14159265358979323846;

/// Smallest share of the light samples for a kind of light that exists.
constexpr float kLeastShare = 0.1f;

/// Probability of the first of two kinds of light with these powers; 0 or 1 if only one exists.
float share_of(double first, double second) {
    if (!(first > 0.0)) return 0.0f;
    if (!(second > 0.0)) return 1.0f;
    return clamp_to(static_cast<float>(first / (first + second)), kLeastShare, 1.0f - kLeastShare);
}

double degrees(double angle) { return angle * kPiExact / 180.0; }

/// Falloff as a line through 1 at the inner cone and 0 at the outer one.
void set_falloff(const PunctualLightDescription& light, DeltaLight& packed) {
    const bool is_cosine = light.falloff == SpotFalloff::Cosine;
    packed.kind = is_cosine ? DeltaLightKind::CosineSpot : DeltaLightKind::AngleSpot;
    const auto along = [&](float angle_deg) {
        const double angle = degrees(static_cast<double>(angle_deg));
        return is_cosine ? std::cos(angle) : angle;
    };
    // Cones may be nearer to each other than numbers tell.
    const double gap = along(light.inner_deg) - along(light.outer_deg);
    const double slope = 1.0 / std::copysign(std::max(std::abs(gap), 0x1p-60), is_cosine ? 1.0 : -1.0);
    packed.slope = static_cast<float>(slope);
    packed.offset = static_cast<float>(-slope * along(light.outer_deg));
}

DeltaLight delta_light(const PunctualLightDescription& light) {
    DeltaLight packed{.intensity = light.intensity, .position = light.position};
    if (light.kind == PunctualKind::Point) return packed;
    packed.axis = Vec3f{glm::normalize(Vec3d{light.direction})};
    packed.kind = DeltaLightKind::Directional;
    if (light.kind == PunctualKind::Spot) set_falloff(light, packed);
    return packed;
}

/// Luminous power divided by pi; of a spot, of a cone half way between its cones; of a directional light, through a disk of this
/// radius.
double power_of(const PunctualLightDescription& light, double radius) {
    const auto intensity = static_cast<double>(luminance(light.intensity));
    switch (light.kind) {
    case PunctualKind::Point: return 4.0 * intensity;
    case PunctualKind::Directional: return radius * radius * intensity;
    case PunctualKind::Spot: break;
    }
    const double angle = degrees(0.5 * (static_cast<double>(light.inner_deg) + static_cast<double>(light.outer_deg)));
    return 2.0 * (1.0 - std::cos(angle)) * intensity;
}

/// Appends cumulative probabilities. They are multiples of 2^-24, as random numbers are, so the tabulated probability
/// of an entry is exact. Weights with a sum of 0 give a uniform distribution.
void append_cdf(const std::vector<double>& weights, double sum, std::vector<float>& cdf) {
    double running = 0.0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        running += sum > 0.0 ? weights[i] / sum : 1.0 / static_cast<double>(weights.size());
        const double share = i + 1 < weights.size() ? std::min(running, 1.0) : 1.0;
        cdf.push_back(static_cast<float>(std::round(share * 0x1p24) * 0x1p-24));
    }
}

/// Entries of a distribution for each bucket of its index: as many as a cache line holds.
constexpr std::uint32_t kEntriesPerBucket = 16;

IndexedCdf without_arrays(std::uint32_t count) {
    return {{}, {}, count, std::bit_ceil(std::max(count / kEntriesPerBucket, 1u))};
}

/// Appends the index of the distribution that `values` end with.
void append_index(const IndexedCdf& cdf, const std::vector<float>& values, std::vector<std::int32_t>& index) {
    const auto first = values.end() - static_cast<std::ptrdiff_t>(cdf.count);
    for (std::uint32_t bucket = 0; bucket <= cdf.buckets; ++bucket) {
        const float begin = static_cast<float>(bucket) / static_cast<float>(cdf.buckets);
        index.push_back(static_cast<std::int32_t>(std::upper_bound(first, values.end() - 1, begin) - first));
    }
}

/// Probabilities of the entries whose cumulative probabilities these are.
std::vector<float> differences(std::span<const float> cdf) {
    std::vector<float> all(cdf.size());
    std::adjacent_difference(cdf.begin(), cdf.end(), all.begin());
    return all;
}

/// Packs the map and returns the integral of its luminance over the sphere.
double pack_map(const EnvironmentMapDescription& map, HostScene& packed) {
    std::vector<double> rows;
    std::vector<double> row(map.width);
    EnvironmentMap& to = packed.far_lights.map;
    to.rows = without_arrays(map.height);
    to.columns = without_arrays(map.width);
    double total = 0.0;
    for (std::uint32_t y = 0; y < map.height; ++y) {
        const double sine = std::sin(kPiExact * (y + 0.5) / map.height);
        double sum = 0.0;
        for (std::uint32_t x = 0; x < map.width; ++x) {
            row[x] = sine * static_cast<double>(luminance(map.texels[std::size_t{y} * map.width + x]));
            sum += row[x];
        }
        append_cdf(row, sum, packed.map_column_cdf);
        append_index(to.columns, packed.map_column_cdf, packed.map_column_index);
        rows.push_back(sum);
        total += sum;
    }
    if (!(total > 0.0)) {
        packed.map_column_cdf.clear();
        packed.map_column_index.clear();
        to = {};
        return 0.0;
    }
    append_cdf(rows, total, packed.map_row_cdf);
    append_index(to.rows, packed.map_row_cdf, packed.map_row_index);
    const std::vector<float> of_rows = differences(packed.map_row_cdf);
    packed.map_texels.reserve(map.texels.size());
    for (std::uint32_t y = 0; y < map.height; ++y) {
        const std::size_t first = std::size_t{y} * map.width;
        const std::vector<float> of_columns = differences(std::span(packed.map_column_cdf).subspan(first, map.width));
        for (std::uint32_t x = 0; x < map.width; ++x)
            packed.map_texels.push_back({map.texels[first + x], of_rows[y] * of_columns[x]});
    }
    to.width = map.width;
    to.height = map.height;
    to.turn = static_cast<float>(std::fmod(static_cast<double>(map.rotation_deg) / 360.0, 1.0));
    to.has_axes = map.axes != glm::mat3(1.0f);
    to.axis_x = map.axes[0];
    to.axis_y = map.axes[1];
    to.axis_z = map.axes[2];
    return total * 2.0 * kPiExact * kPiExact / (static_cast<double>(map.width) * map.height);
}

double pack_sun(const SunDescription& sun, HostScene& packed) {
    const double power = static_cast<double>(luminance(sun.radiance));
    if (!(power > 0.0)) return 0.0;
    const double half_sine = std::sin(static_cast<double>(sun.angle_deg) / 4.0 * kPiExact / 180.0);
    const double chord2 = 4.0 * half_sine * half_sine;
    packed.far_lights.sun = {Vec3f{glm::normalize(Vec3d{sun.direction})}, static_cast<float>(chord2), sun.radiance};
    return power * kPiExact * chord2;
}

}  // namespace

double pack_far_lights(const SceneDescription& scene, HostScene& packed) {
    const double map = scene.environment_map.texels.empty() ? 0.0 : pack_map(scene.environment_map, packed);
    const double sun = pack_sun(scene.sun, packed);
    packed.far_lights.map_probability = share_of(map, sun);
    const double radius = 0.5 * static_cast<double>(bounds_of(scene).diagonal());
    // Power: pi x area x radiance for emissive triangles, pi r^2 x the integral over the sphere for far lights.
    const double power = radius * radius * (map + sun);
    packed.far_probability = share_of(power, static_cast<double>(packed.light_power));
    if (packed.far_probability < 1.0f) packed.light_power /= 1.0f - packed.far_probability;
    return power;
}

void pack_delta_lights(const SceneDescription& scene, double far_power, HostScene& packed) {
    const double radius = 0.5 * static_cast<double>(bounds_of(scene).diagonal());
    double power = 0.0;
    for (const PunctualLightDescription& light : scene.punctual_lights) {
        if (is_black(light.intensity)) continue;
        packed.delta_lights.push_back(delta_light(light));
        power += power_of(light, radius);
    }
    if (packed.delta_lights.empty()) return;
    // By as many bits that one minus the probability is exact.
    const double others = far_power + static_cast<double>(packed.light_power * (1.0f - packed.far_probability));
    const float probability = std::round(share_of(power, others) * 0x1p10f) * 0x1p-10f;
    packed.delta_probability = probability;
    packed.far_probability *= 1.0f - probability;
    if (probability < 1.0f) packed.light_power /= 1.0f - probability;
}

}  // namespace pl
