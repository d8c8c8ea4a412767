// Infinitely distant lights that depend on the direction: an environment map and a sun.
#pragma once

#include "core/kernel/base/frame.h"
#include "core/kernel/shading/environment_map.h"

namespace pl {

/// A disk of constant radiance: the directions w with |w - direction|^2 < chord2. It subtends exactly pi chord2
/// steradians, because Lambert's azimuthal projection preserves areas.
struct Sun {
    Vec3f direction{0.0f, 1.0f, 0.0f};  ///< unit, towards the sun
    float chord2 = 0.0f;                ///< 2 (1 - cos(angular radius)); 0: no sun
    Vec3f radiance{0.0f};

    PL_HD bool empty() const { return chord2 == 0.0f; }
};

template <class N>
PL_INLINE typename N::Mask in_sun(const Sun& sun, const Real3<N>& direction) {
    const Real3<N> chord = direction - constant_vector<N>(sun.direction);
    return dot(chord, chord) < sun.chord2;
}
PL_HD inline bool in_sun(const Sun& sun, Vec3f direction) { return in_sun(sun, unpack(direction)); }
/// Density of sample_sun() per steradian at a direction that is in_sun().
PL_INLINE float inside_sun_pdf_sa(const Sun& sun) { return kInvPi / sun.chord2; }

/// Uniform direction of the disk; u in [0,1)^2. Density: 1 / (pi chord2) per steradian.
template <class N>
PL_INLINE Real3<N> sample_sun(const Sun& sun, const Real2<N>& u) {
    const Real2<N> disk = square_to_disk(u);
    const typename N::Real r2 = (disk.x * disk.x + disk.y * disk.y) * sun.chord2;
    const typename N::Real across = N::sqrt(sun.chord2 * (1.0f - 0.25f * r2));
    return make_frame(constant_vector<N>(sun.direction))
        .to_world({disk.x * across, disk.y * across, 1.0f - 0.5f * r2});
}
PL_HD inline Vec3f sample_sun(const Sun& sun, Vec2f u) { return pack(sample_sun(sun, unpack(u))); }

/// Environment map and sun; either may be missing.
struct FarLights {
    EnvironmentMap map;
    Sun sun;
    float map_probability = 0.0f;  ///< probability of sampling the map instead of the sun

    PL_HD bool empty() const { return map.empty() && sun.empty(); }
};

/// The far lights in one direction.
template <class N>
class FarDirection {
public:
    /// `place`: of the unit direction on the map; without a map it is arbitrary.
    PL_INLINE FarDirection(const FarLights& lights, const Real3<N>& direction, const MapPlaceOf<N>& place)
        : lights_(lights), is_in_sun_(in_sun(lights.sun, direction)), sine_(place.sine) {
        if (!lights.map.empty()) taps_ = map_taps(lights.map, place.point);
    }

    PL_INLINE Real3<N> radiance() const {
        Real3<N> radiance = constant_vector<N>(Vec3f{0.0f});
        if (!lights_.map.empty()) radiance = map_radiance(lights_.map, taps_);
        return select(is_in_sun_, radiance + constant_vector<N>(lights_.sun.radiance), radiance);
    }
    /// Density of sample_far() per steradian.
    PL_INLINE typename N::Real pdf_sa() const {
        const float of_sun = (1.0f - lights_.map_probability) * inside_sun_pdf_sa(lights_.sun);
        const typename N::Real pdf_sa = select(is_in_sun_, N::constant(of_sun), N::constant(0.0f));
        if (lights_.map.empty()) return pdf_sa;
        return pdf_sa + lights_.map_probability * map_pdf_sa(lights_.map, taps_, sine_);
    }

private:
    const FarLights& lights_;
    typename N::Mask is_in_sun_;
    typename N::Real sine_;
    MapTapsOf<N> taps_{};
};
PL_HD inline FarDirection<One> far_direction(const FarLights& lights, Vec3f direction) {
    return {lights, unpack(direction), lights.map.empty() ? MapPlace{} : map_place(lights.map, unpack(direction))};
}
PL_HD inline Vec3f far_radiance(const FarLights& lights, Vec3f direction) {
    return pack(far_direction(lights, direction).radiance());
}
PL_HD inline float far_pdf_sa(const FarLights& lights, Vec3f direction) {
    return far_direction(lights, direction).pdf_sa();
}

/// A sample of the far lights.
template <class N>
struct FarSampleOf {
    Real3<N> wi;  ///< unit
    Real3<N> radiance;
    typename N::Real pdf_sa;
};
struct FarSample {
    Vec3f wi{0.0f};
    Vec3f radiance{0.0f};
    float pdf_sa = 0.0f;
};

/// Samples the map or the sun, by `choice` in [0, 1); u in [0,1)^2. The lights must not be empty. texel(): sample_texel() of the map by u,
/// called if the map is sampled.
template <class N>
PL_INLINE FarSampleOf<N> sample_far(const FarLights& lights, const Real2<N>& u, const typename N::Real& choice,
                                    const auto& texel) {
    const typename N::Mask of_map = choice < lights.map_probability;
    const typename N::Mask of_sun = !(choice < lights.map_probability);
    MapDirection<N> sampled{};
    if (N::any(of_map)) sampled = sample_map_direction<N>(lights.map, texel());
    if (N::any(of_sun)) {
        // Rounding may put a direction just outside of the rim; radiance and density then both exclude the sun.
        const Real3<N> wi = sample_sun(lights.sun, u);
        sampled.wi = select(of_sun, wi, sampled.wi);
        if (!lights.map.empty()) {
            const MapPlaceOf<N> place = map_place(lights.map, wi);
            sampled.place = {select(of_sun, place.point, sampled.place.point),
                             select(of_sun, place.sine, sampled.place.sine)};
        }
    }
    const FarDirection<N> far(lights, sampled.wi, sampled.place);
    return {sampled.wi, far.radiance(), far.pdf_sa()};
}
PL_HOST_APART PL_HD inline FarSample sample_far(const FarLights& lights, Vec2f u, float choice) {
    const FarSampleOf<One> sample =
        sample_far<One>(lights, unpack(u), choice, [&] { return sample_texel(lights.map, unpack(u)); });
    return {pack(sample.wi), pack(sample.radiance), sample.pdf_sa};
}

}  // namespace pl
