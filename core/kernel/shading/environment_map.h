// Environment map in latitude and longitude, importance sampled by its luminance.
#pragma once

#include "core/kernel/base/angles.h"
#include "core/kernel/base/bilinear.h"
#include "core/kernel/base/span.h"
#include "core/kernel/base/warp.h"

namespace pl {

/// The first row is up (+y); without a turn the middle column is -z and the columns to its right approach +x.
struct EnvironmentMap {
    Span<const Vec3f> texels;      ///< [row][column], radiance, row 0 at the top; empty: no map
    Span<const float> row_cdf;     ///< [row], marginal cumulative probabilities; multiples of 2^-24, the last one 1
    Span<const float> column_cdf;  ///< [row][column], conditional cumulative probabilities, as row_cdf in each row
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    float turn = 0.0f;  ///< counter-clockwise about +y, in turns

    PL_HD bool empty() const { return texels.empty(); }
};

/// Image coordinates of a unit direction: u to the right, v down, both in [0, 1].
PL_HD inline Vec2f map_point(const EnvironmentMap& map, Vec3f direction) {
    const float u = 0.5f + turns_of(direction.x, -direction.z) + map.turn;
    const float across = std::sqrt(direction.x * direction.x + direction.z * direction.z);
    return {u - std::floor(u), 2.0f * turns_of(across, direction.y)};
}

/// Bilinear taps at a point of the image.
struct MapTaps {
    Taps x, y;
};
PL_HD inline MapTaps map_taps(const EnvironmentMap& map, Vec2f point) {
    return {taps_at(point.x, map.width, true), taps_at(point.y, map.height, false)};
}

/// Incident radiance from the direction of the taps.
PL_HD inline Vec3f map_radiance(const EnvironmentMap& map, const MapTaps& at) {
    const auto texel = [&](std::uint32_t column, std::uint32_t row) { return map.texels[row * map.width + column]; };
    return bilinear(at.x, at.y, texel(at.x.low, at.y.low), texel(at.x.high, at.y.low), texel(at.x.low, at.y.high),
                    texel(at.x.high, at.y.high));
}
PL_HD inline Vec3f map_radiance(const EnvironmentMap& map, Vec3f direction) {
    return map_radiance(map, map_taps(map, map_point(map, direction)));
}

/// Probability of entry `i` of the distribution whose cumulative probabilities begin at `first`.
PL_HD inline float cdf_share(Span<const float> cdf, std::uint32_t first, std::uint32_t i) {
    return cdf[first + i] - (i > 0 ? cdf[first + i - 1] : 0.0f);
}

/// Density of sample_map_point() over the unit square. Bilinear between the centers of texels, like the radiance, so
/// the two are nearly proportional; exact, because the tents around texels sum to bilinear interpolation.
PL_HD inline float map_density(const EnvironmentMap& map, const MapTaps& at) {
    const auto texel = [&](std::uint32_t column, std::uint32_t row) {
        return cdf_share(map.row_cdf, 0, row) * cdf_share(map.column_cdf, row * map.width, column);
    };
    const float p = bilinear(at.x, at.y, texel(at.x.low, at.y.low), texel(at.x.high, at.y.low),
                             texel(at.x.low, at.y.high), texel(at.x.high, at.y.high));
    return p * static_cast<float>(map.width) * static_cast<float>(map.height);
}

/// Density per steradian: rows shrink by `sine`, the sine of the angle from +y. 0 at the poles.
PL_HD inline float map_pdf_sa(const EnvironmentMap& map, const MapTaps& at, float sine) {
    return sine > 0.0f ? map_density(map, at) * (0.5f * kInvPi * kInvPi) / sine : 0.0f;
}
PL_HD inline float map_pdf_sa(const EnvironmentMap& map, Vec3f direction) {
    const float sine = std::sqrt(direction.x * direction.x + direction.z * direction.z);
    return map_pdf_sa(map, map_taps(map, map_point(map, direction)), sine);
}

/// The interval of a discrete distribution that contains a uniform number.
struct CdfStep {
    std::uint32_t entry;
    float position;  ///< of the number in the interval, in [0, 1]
};
PL_HD inline CdfStep find_in_cdf(Span<const float> cdf, std::uint32_t first, std::uint32_t count, float u) {
    const std::uint32_t low = find_interval(count, u, [&](std::uint32_t entry) { return cdf[first + entry]; });
    const float start = low > 0 ? cdf[first + low - 1] : 0.0f;
    return {low, (u - start) / (cdf[first + low] - start)};
}

/// Samples a texel by its probability, then a tent around its center that extends into the neighbors; u in [0,1)^2.
PL_HD inline Vec2f sample_map_point(const EnvironmentMap& map, Vec2f u) {
    const CdfStep row = find_in_cdf(map.row_cdf, 0, map.height, u.y);
    const CdfStep column = find_in_cdf(map.column_cdf, row.entry * map.width, map.width, u.x);
    const auto width = static_cast<float>(map.width);
    const auto height = static_cast<float>(map.height);
    const float x = (static_cast<float>(column.entry) + 0.5f + sample_tent<One>(column.position)) / width;
    const float y = static_cast<float>(row.entry) + 0.5f + sample_tent<One>(row.position);
    return {x - std::floor(x), reflect_into<One>(y, height) / height};
}

/// A sample of a far light.
struct FarSample {
    Vec3f wi{0.0f};  ///< unit
    Vec3f radiance{0.0f};
    float pdf_sa = 0.0f;
};

/// Samples a direction of the map, which must not be empty; u in [0,1)^2.
PL_HD inline FarSample sample_map(const EnvironmentMap& map, Vec2f u) {
    const Vec2f point = sample_map_point(map, u);
    const SineCosine longitude = sine_cosine_of_turns(point.x - 0.5f - map.turn);
    const SineCosine colatitude = sine_cosine_of_turns(0.5f * point.y);
    const MapTaps at = map_taps(map, point);
    const float sine = max_of(colatitude.sine, 0.0f);
    return {.wi = {sine * longitude.sine, colatitude.cosine, -sine * longitude.cosine},
            .radiance = map_radiance(map, at),
            .pdf_sa = map_pdf_sa(map, at, sine)};
}

}  // namespace pl
