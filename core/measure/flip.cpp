#include "core/measure/flip.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "core/base/error.h"

namespace pl {
namespace {

// Exponents and knee of the color difference, exponent and width of the feature difference.   [section 4, table 1]
constexpr double kColorExponent = 0.7;
constexpr double kKneeInput = 0.4;
constexpr double kKneeOutput = 0.95;
constexpr double kFeatureExponent = 0.5;
constexpr double kFeatureWidthDegrees = 0.082;

using Plane = std::vector<double>;

/// One number per pixel, with the size of the picture.
struct Grid {
    int width;
    int height;

    std::size_t size() const { return index(0, height); }
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
};

/// Weights of the pixels from -radius to radius.
struct Kernel {
    int radius;
    std::vector<double> weights;

    template <class Weight>
    Kernel(int reach, Weight&& weight) : radius(reach) {
        for (int i = -reach; i <= reach; ++i) weights.push_back(weight(static_cast<double>(i)));
    }
    double sum() const { return std::accumulate(weights.begin(), weights.end(), 0.0); }
    void scale(double factor) {
        for (double& weight : weights) weight *= factor;
    }
    /// Positive weights add up to 1, negative ones to -1.
    void balance() {
        double positive = 0.0;
        double negative = 0.0;
        for (const double weight : weights) (weight > 0.0 ? positive : negative) += weight;
        for (double& weight : weights) weight /= weight > 0.0 ? positive : -negative;
    }
};

/// Convolution along rows or columns; pixels of the border repeat beyond it.
Plane filtered(const Plane& plane, const Grid& grid, const Kernel& kernel, bool along_rows) {
    Plane result(plane.size(), 0.0);
    const int length = along_rows ? grid.width : grid.height;
    for (int y = 0; y < grid.height; ++y)
        for (int x = 0; x < grid.width; ++x) {
            double sum = 0.0;
            for (int k = -kernel.radius; k <= kernel.radius; ++k) {
                const int at = std::clamp((along_rows ? x : y) + k, 0, length - 1);
                const std::size_t from = along_rows ? grid.index(at, y) : grid.index(x, at);
                sum += kernel.weights[static_cast<std::size_t>(k + kernel.radius)] * plane[from];
            }
            result[grid.index(x, y)] = sum;
        }
    return result;
}

/// Linear sRGB to CIE XYZ with D65 as white, and back.
const glm::dmat3 kToXyz(0.41238656, 0.21263682, 0.01933062,  // columns
                        0.35759149, 0.71518298, 0.11919716,  //
                        0.18045049, 0.07218020, 0.95037259);
const glm::dmat3 kFromXyz = glm::inverse(kToXyz);
const Vec3d kWhite = kToXyz * Vec3d(1.0);

/// Lightness and two linear opponent colors.   [section 4.1]
Vec3d to_opponents(const Vec3d& rgb) {
    const Vec3d n = kToXyz * rgb / kWhite;
    return {116.0 * n.y - 16.0, 500.0 * (n.x - n.y), 200.0 * (n.y - n.z)};
}

Vec3d from_opponents(const Vec3d& color) {
    const double y = (color.x + 16.0) / 116.0;
    return kFromXyz * (Vec3d(y + color.y / 500.0, y, y - color.z / 200.0) * kWhite);
}

/// CIELAB with the Hunt effect: colors are less vivid in the dark.   [Hunt 1952]
Vec3d to_hunt_lab(const Vec3d& rgb) {
    const auto curve = [](double t) {
        constexpr double kDelta = 6.0 / 29.0;
        return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
    };
    const Vec3d n = kToXyz * rgb / kWhite;
    const double lightness = 116.0 * curve(n.y) - 16.0;
    const double vividness = 0.01 * lightness;
    return {lightness, vividness * 500.0 * (curve(n.x) - curve(n.y)), vividness * 200.0 * (curve(n.y) - curve(n.z))};
}

/// HyAB: city-block distance between lightness and color, raised to a power.   [Abasi et al. 2020]
double color_distance(const Vec3d& a, const Vec3d& b) {
    const Vec3d d = a - b;
    return std::pow(std::fabs(d.x) + std::hypot(d.y, d.z), kColorExponent);
}

/// The largest distance, from green to blue, becomes 1; distances above the knee share the last twentieth.
double compressed(double distance) {
    static const double largest = color_distance(to_hunt_lab({0.0, 1.0, 0.0}), to_hunt_lab({0.0, 0.0, 1.0}));
    const double knee = kKneeInput * largest;
    if (distance < knee) return kKneeOutput / knee * distance;
    return std::min(kKneeOutput + (distance - knee) / (largest - knee) * (1.0 - kKneeOutput), 1.0);
}

struct Gaussian {
    double height;
    double spread;  ///< square degrees
};

/// The eye's contrast sensitivity by opponent color, as sums of Gaussians.   [section 4.1, table 1]
const std::vector<Gaussian> kSensitivity[3] = {{{1.0, 0.0047}}, {{1.0, 0.0053}}, {{34.1, 0.04}, {13.5, 0.025}}};

/// A channel filtered by the contrast sensitivity of the eye.
Plane seen(const Plane& plane, const Grid& grid, int channel, double pixels_per_degree) {
    constexpr double kWidest = 0.04;
    const int radius = static_cast<int>(
        std::ceil(3.0 * std::sqrt(kWidest / (2.0 * std::numbers::pi * std::numbers::pi)) * pixels_per_degree));
    Plane result(plane.size(), 0.0);
    double total = 0.0;
    for (const Gaussian& part : kSensitivity[channel]) {
        Kernel kernel(radius, [&](double i) {
            const double degrees = i / pixels_per_degree;
            return std::exp(-std::numbers::pi * std::numbers::pi * degrees * degrees / part.spread);
        });
        const double sum = kernel.sum();
        const double share = part.height * std::sqrt(std::numbers::pi / part.spread) * sum * sum;
        kernel.scale(1.0 / sum);
        const Plane blurred = filtered(filtered(plane, grid, kernel, true), grid, kernel, false);
        for (std::size_t i = 0; i < result.size(); ++i) result[i] += share * blurred[i];
        total += share;
    }
    for (double& value : result) value /= total;
    return result;
}

/// Strength of edges and of points around each pixel, from lightness in [0, 1].   [section 4.2]
std::array<Plane, 2> features_of(const Plane& lightness, const Grid& grid, double pixels_per_degree) {
    const double deviation = 0.5 * kFeatureWidthDegrees * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3.0 * deviation));
    const auto bell = [&](double i) { return std::exp(-i * i / (2.0 * deviation * deviation)); };
    Kernel smooth(radius, bell);
    smooth.scale(1.0 / smooth.sum());
    Kernel slope(radius, [&](double i) { return -i * bell(i); });
    slope.balance();
    Kernel bend(radius, [&](double i) { return (i * i / (deviation * deviation) - 1.0) * bell(i); });
    bend.balance();
    const auto strength = [&](const Kernel& kernel) {
        Plane x = filtered(filtered(lightness, grid, kernel, true), grid, smooth, false);
        const Plane y = filtered(filtered(lightness, grid, smooth, true), grid, kernel, false);
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::hypot(x[i], y[i]);
        return x;
    };
    return {strength(slope), strength(bend)};
}

/// A picture in the terms of the metric: filtered colors and features.
struct Impression {
    std::vector<Vec3d> colors;
    std::array<Plane, 2> features;  ///< edges, points
};

double shown(float radiance) { return radiance > 0.0f ? std::min(static_cast<double>(radiance), 1.0) : 0.0; }

Impression impression_of(Pixels picture, const Grid& grid, double pixels_per_degree) {
    Plane channels[3];
    for (const Vec3f& pixel : picture) {
        const Vec3d color = to_opponents({shown(pixel.x), shown(pixel.y), shown(pixel.z)});
        for (int c = 0; c < 3; ++c) channels[c].push_back(color[c]);
    }
    Plane lightness = channels[0];
    for (double& value : lightness) value = (value + 16.0) / 116.0;
    Impression result{.colors = {}, .features = features_of(lightness, grid, pixels_per_degree)};
    for (int c = 0; c < 3; ++c) channels[c] = seen(channels[c], grid, c, pixels_per_degree);
    for (std::size_t i = 0; i < grid.size(); ++i) {
        const Vec3d rgb = from_opponents({channels[0][i], channels[1][i], channels[2][i]});
        result.colors.push_back(to_hunt_lab(glm::clamp(rgb, 0.0, 1.0)));
    }
    return result;
}

}  // namespace

std::vector<float> flip_map(Pixels picture, Pixels reference, int width, double pixels_per_degree) {
    if (picture.size() != reference.size() || width < 1 || picture.size() % static_cast<std::size_t>(width) != 0)
        throw Error(ErrorKind::Input,
                    "expected two pictures of the same size in full rows, got " + std::to_string(picture.size()) +
                        " and " + std::to_string(reference.size()) + " pixels in rows of " + std::to_string(width));
    const Grid grid{width, static_cast<int>(picture.size() / static_cast<std::size_t>(width))};
    const Impression a = impression_of(picture, grid, pixels_per_degree);
    const Impression b = impression_of(reference, grid, pixels_per_degree);
    std::vector<float> map;
    map.reserve(grid.size());
    for (std::size_t i = 0; i < grid.size(); ++i) {
        const double color = compressed(color_distance(a.colors[i], b.colors[i]));
        const double edge = std::fabs(a.features[0][i] - b.features[0][i]);
        const double point = std::fabs(a.features[1][i] - b.features[1][i]);
        const double feature = std::pow(std::max(edge, point) / std::numbers::sqrt2, kFeatureExponent);
        map.push_back(static_cast<float>(std::pow(color, 1.0 - feature)));
    }
    return map;
}

double mean_of(const std::vector<float>& map) {
    const double sum = std::accumulate(map.begin(), map.end(), 0.0);
    return map.empty() ? 0.0 : sum / static_cast<double>(map.size());
}

}  // namespace pl
