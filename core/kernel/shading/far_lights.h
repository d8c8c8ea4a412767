// Light from infinitely far away that depends on the direction: an image over all directions, and a sun.
#pragma once

#include "core/kernel/base/frame.h"
#include "core/kernel/shading/environment_map.h"

namespace pl {

/// A disc of constant radiance. Its size is that of its chord: directions w with |w - direction|^2 < chord2 are in it,
/// and it fills exactly pi chord2 steradians, because the map from the sphere to chords keeps areas (Lambert's
/// azimuthal one).
struct Sun {
    Vec3f direction{0.0f, 1.0f, 0.0f};  ///< towards it, unit
    float chord2 = 0.0f;                ///< 2 (1 - cos of half of its angle); 0: there is none
    Vec3f radiance{0.0f};

    PL_HD bool empty() const { return chord2 == 0.0f; }
};

PL_HD inline bool in_sun(const Sun& sun, Vec3f direction) {
    const Vec3f chord = direction - sun.direction;
    return glm::dot(chord, chord) < sun.chord2;
}
PL_HD inline float sun_pdf_sa(const Sun& sun, Vec3f direction) {
    return in_sun(sun, direction) ? kInvPi / sun.chord2 : 0.0f;
}

/// A direction of the disc, all equally probable; u in [0,1)^2.
PL_HD inline Vec3f sample_sun(const Sun& sun, Vec2f u) {
    const Vec2f disk = square_to_disk(u);
    const float r2 = (disk.x * disk.x + disk.y * disk.y) * sun.chord2;
    const float across = std::sqrt(sun.chord2 * (1.0f - 0.25f * r2));
    return make_frame(sun.direction).to_world({disk.x * across, disk.y * across, 1.0f - 0.5f * r2});
}

/// Both lights; either may be missing.
struct FarLights {
    EnvironmentMap map;
    Sun sun;
    float map_probability = 0.0f;  ///< that a sample is one of the map rather than of the sun

    PL_HD bool empty() const { return map.empty() && sun.empty(); }
};

PL_HD inline Vec3f far_radiance(const FarLights& lights, Vec3f direction) {
    Vec3f radiance{0.0f};
    if (!lights.map.empty()) radiance = map_radiance(lights.map, direction);
    if (in_sun(lights.sun, direction)) radiance += lights.sun.radiance;
    return radiance;
}

/// Density of sample_far() per steradian.
PL_HD inline float far_pdf_sa(const FarLights& lights, Vec3f direction) {
    float pdf_sa = (1.0f - lights.map_probability) * sun_pdf_sa(lights.sun, direction);
    if (!lights.map.empty()) pdf_sa += lights.map_probability * map_pdf_sa(lights.map, direction);
    return pdf_sa;
}

/// `choice` in [0, 1) takes the map or the sun; u in [0,1)^2. The lights must not be empty.
PL_HD inline FarSample sample_far(const FarLights& lights, Vec2f u, float choice) {
    if (choice < lights.map_probability) {
        FarSample sample = sample_map(lights.map, u);
        sample.pdf_sa = lights.map_probability * sample.pdf_sa +
                        (1.0f - lights.map_probability) * sun_pdf_sa(lights.sun, sample.wi);
        if (in_sun(lights.sun, sample.wi)) sample.radiance += lights.sun.radiance;
        return sample;
    }
    const Vec3f wi = sample_sun(lights.sun, u);
    // Rounding may leave a direction on the rim just outside: then the sun's share is missing from both.
    return {.wi = wi, .radiance = far_radiance(lights, wi), .pdf_sa = far_pdf_sa(lights, wi)};
}

}  // namespace pl
