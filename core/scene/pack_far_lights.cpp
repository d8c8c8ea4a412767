#include "core/scene/pack_far_lights.h"

#include <cmath>
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

/// Packs the map and returns the integral of its luminance over the sphere.
double pack_map(const EnvironmentMapDescription& map, HostScene& packed) {
    std::vector<double> rows;
    std::vector<double> row(map.width);
    double total = 0.0;
    for (std::uint32_t y = 0; y < map.height; ++y) {
        const double sine = std::sin(kPiExact * (y + 0.5) / map.height);
        double sum = 0.0;
        for (std::uint32_t x = 0; x < map.width; ++x) {
            row[x] = sine * static_cast<double>(luminance(map.texels[std::size_t{y} * map.width + x]));
            sum += row[x];
        }
        append_cdf(row, sum, packed.map_column_cdf);
        rows.push_back(sum);
        total += sum;
    }
    if (!(total > 0.0)) {
        packed.map_column_cdf.clear();
        return 0.0;
    }
    append_cdf(rows, total, packed.map_row_cdf);
    packed.map_texels = map.texels;
    packed.far_lights.map.width = map.width;
    packed.far_lights.map.height = map.height;
    packed.far_lights.map.turn = static_cast<float>(std::fmod(static_cast<double>(map.rotation_deg) / 360.0, 1.0));
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

void pack_far_lights(const SceneDescription& scene, HostScene& packed) {
    const double map = scene.environment_map.texels.empty() ? 0.0 : pack_map(scene.environment_map, packed);
    const double sun = pack_sun(scene.sun, packed);
    packed.far_lights.map_probability = share_of(map, sun);
    const double radius = 0.5 * static_cast<double>(bounds_of(scene).diagonal());
    // Power: pi x area x radiance for emissive triangles, pi r^2 x the integral over the sphere for far lights.
    packed.far_probability = share_of(radius * radius * (map + sun), static_cast<double>(packed.light_power));
    if (packed.far_probability < 1.0f) packed.light_power /= 1.0f - packed.far_probability;
}

}  // namespace pl
