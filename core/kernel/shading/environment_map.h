// Environment map in latitude and longitude, importance sampled by its luminance.
#pragma once

#include "core/kernel/base/angles.h"
#include "core/kernel/base/bilinear.h"
#include "core/kernel/base/indexed_cdf.h"
#include "core/kernel/base/warp.h"

namespace pl {

/// Radiance and probability lie next to each other: samples and directions that are hit need both.
struct alignas(16) MapTexel {
    Vec3f radiance;
    float probability;  ///< of the texel among the samples of the map
};

/// The first row is up (+y); without a turn the middle column is -z and the columns to its right approach +x: in the world, or in axes of
/// the map's own, which are orthonormal and may be left-handed.
struct EnvironmentMap {
    Span<const MapTexel> texels;  ///< [row][column], row 0 at the top; empty: no map
    IndexedCdf rows;              ///< one distribution, over the rows
    IndexedCdf columns;           ///< one for each row, over its columns
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    float turn = 0.0f;  ///< counter-clockwise about +y, in turns
    bool has_axes = false;
    Vec3f axis_x{1.0f, 0.0f, 0.0f};  ///< in the world, as the next two
    Vec3f axis_y{0.0f, 1.0f, 0.0f};
    Vec3f axis_z{0.0f, 0.0f, 1.0f};

    PL_INLINE bool empty() const { return texels.count == 0; }
};

/// A direction of the world in the axes of the map.
template <class N>
PL_INLINE Real3<N> to_map(const EnvironmentMap& map, const Real3<N>& direction) {
    if (!map.has_axes) return direction;
    return {dot(direction, constant_vector<N>(map.axis_x)), dot(direction, constant_vector<N>(map.axis_y)),
            dot(direction, constant_vector<N>(map.axis_z))};
}

/// The inverse of to_map().
template <class N>
PL_INLINE Real3<N> from_map(const EnvironmentMap& map, const Real3<N>& direction) {
    if (!map.has_axes) return direction;
    return scaled(constant_vector<N>(map.axis_x), direction.x) + scaled(constant_vector<N>(map.axis_y), direction.y) +
           scaled(constant_vector<N>(map.axis_z), direction.z);
}

/// A direction as a point of the map.
template <class N>
struct MapPlaceOf {
    Real2<N> point;         ///< image coordinates: u to the right, v down, both in [0, 1]
    typename N::Real sine;  ///< of the angle from the map's +y
};
using MapPlace = MapPlaceOf<One>;

/// The place of a unit direction.
template <class N>
PL_INLINE MapPlaceOf<N> map_place(const EnvironmentMap& map, const Real3<N>& world_direction) {
    const Real3<N> direction = to_map(map, world_direction);
    const typename N::Real u = 0.5f + turns_of<N>(direction.x, -direction.z) + map.turn;
    const typename N::Real sine = N::sqrt(direction.x * direction.x + direction.z * direction.z);
    return {{u - N::floor(u), 2.0f * turns_of<N>(sine, direction.y)}, sine};
}

/// Bilinear taps at a point of the image.
template <class N>
struct MapTapsOf {
    TapsOf<N> x, y;
};
using MapTaps = MapTapsOf<One>;
template <class N>
PL_INLINE MapTapsOf<N> map_taps(const EnvironmentMap& map, const Real2<N>& point) {
    return {taps_at<N>(point.x, map.width, true), taps_at<N>(point.y, map.height, false)};
}
PL_HD inline MapTaps map_taps(const EnvironmentMap& map, Vec2f point) { return map_taps(map, unpack(point)); }

/// Bilinear interpolation of load(index) of texels.
template <class N>
PL_INLINE auto at_taps(const EnvironmentMap& map, const MapTapsOf<N>& at, const auto& load) {
    const auto texel = [&](const typename N::Uint& column, const typename N::Uint& row) {
        return load(N::to_int(row * map.width + column));
    };
    return bilinear(at.x, at.y, texel(at.x.low, at.y.low), texel(at.x.high, at.y.low), texel(at.x.low, at.y.high),
                    texel(at.x.high, at.y.high));
}

/// Incident radiance from the direction of the taps.
template <class N>
PL_INLINE Real3<N> map_radiance(const EnvironmentMap& map, const MapTapsOf<N>& at) {
    const auto* floats = static_cast<const float*>(static_cast<const void*>(map.texels.data));
    return at_taps<N>(map, at, [&](const typename N::Int& i) {
        return Real3<N>{N::load(floats, 4 * i), N::load(floats, 4 * i + 1), N::load(floats, 4 * i + 2)};
    });
}
PL_HD inline Vec3f map_radiance(const EnvironmentMap& map, Vec3f direction) {
    return pack(map_radiance(map, map_taps(map, map_place(map, unpack(direction)).point)));
}

/// Density of sample_map_point() over the unit square. Bilinear between the centers of texels, like the radiance, so
/// the two are nearly proportional; exact, because the tents around texels sum to bilinear interpolation.
template <class N>
PL_INLINE typename N::Real map_density(const EnvironmentMap& map, const MapTapsOf<N>& at) {
    const auto* floats = static_cast<const float*>(static_cast<const void*>(map.texels.data));
    const typename N::Real p =
        at_taps<N>(map, at, [&](const typename N::Int& i) { return N::load(floats, 4 * i + 3); });
    return p * static_cast<float>(map.width) * static_cast<float>(map.height);
}

/// Density per steradian: rows shrink by `sine`, see MapPlaceOf. 0 at the poles.
template <class N>
PL_INLINE typename N::Real map_pdf_sa(const EnvironmentMap& map, const MapTapsOf<N>& at,
                                      const typename N::Real& sine) {
    const typename N::Real pdf_sa = map_density(map, at) * (0.5f * kInvPi * kInvPi) / sine;
    return select(static_cast<typename N::Mask>(sine > 0.0f), pdf_sa, N::constant(0.0f));
}
PL_HD inline float map_pdf_sa(const EnvironmentMap& map, Vec3f direction) {
    const MapPlace place = map_place(map, unpack(direction));
    return map_pdf_sa(map, map_taps(map, place.point), place.sine);
}

/// A texel, chosen by its probability.
template <class N>
struct SampledTexelOf {
    CdfSampleOf<N> row, column;
};
/// u in [0,1)^2.
template <class N>
PL_INLINE SampledTexelOf<N> sample_texel(const EnvironmentMap& map, const Real2<N>& u) {
    const CdfSampleOf<N> row = sample_cdf<N>(map.rows, N::constant(0), u.y);
    return {row, sample_cdf<N>(map.columns, row.entry, u.x)};
}

/// Samples the tent around the center of a sampled texel, which extends into the neighbors.
template <class N>
PL_INLINE Real2<N> sample_map_point(const EnvironmentMap& map, const SampledTexelOf<N>& texel) {
    const auto& [row, column] = texel;
    const auto width = static_cast<float>(map.width);
    const auto height = static_cast<float>(map.height);
    const typename N::Real x = (N::to_real(column.entry) + 0.5f + sample_tent<N>(column.position)) / width;
    const typename N::Real y = N::to_real(row.entry) + 0.5f + sample_tent<N>(row.position);
    return {x - N::floor(x), reflect_into<N>(y, height) / height};
}
PL_HD inline Vec2f sample_map_point(const EnvironmentMap& map, Vec2f u) {
    return pack(sample_map_point(map, sample_texel(map, unpack(u))));
}

/// A direction on the map with its place.
template <class N>
struct MapDirection {
    Real3<N> wi;  ///< unit
    MapPlaceOf<N> place;
};

/// Samples a direction towards a sampled texel of the map, with density map_pdf_sa().
template <class N>
PL_INLINE MapDirection<N> sample_map_direction(const EnvironmentMap& map, const SampledTexelOf<N>& texel) {
    const Real2<N> point = sample_map_point(map, texel);
    const SineCosineOf<N> longitude = sine_cosine_of_turns<N>(point.x - 0.5f - map.turn);
    const SineCosineOf<N> colatitude = sine_cosine_of_turns<N>(0.5f * point.y);
    const typename N::Real sine = max_real<N>(colatitude.sine, 0.0f);
    const Real3<N> direction{sine * longitude.sine, colatitude.cosine, -sine * longitude.cosine};
    return {from_map(map, direction), {point, sine}};
}

}  // namespace pl
