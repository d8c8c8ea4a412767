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

PL_HD inline bool in_sun(const Sun& sun, Vec3f direction) {
    const Vec3f chord = direction - sun.direction;
    return glm::dot(chord, chord) < sun.chord2;
}
PL_HD inline float sun_pdf_sa(const Sun& sun, Vec3f direction) {
    return in_sun(sun, direction) ? kInvPi / sun.chord2 : 0.0f;
}

/// Uniform direction of the disk; u in [0,1)^2. Density: 1 / (pi chord2) per steradian.
PL_HD inline Vec3f sample_sun(const Sun& sun, Vec2f u) {
    const Vec2f disk = square_to_disk(u);
    const float r2 = (disk.x * disk.x + disk.y * disk.y) * sun.chord2;
    const float across = std::sqrt(sun.chord2 * (1.0f - 0.25f * r2));
    return make_frame(sun.direction).to_world({disk.x * across, disk.y * across, 1.0f - 0.5f * r2});
}

/// Environment map and sun; either may be missing.
struct FarLights {
    EnvironmentMap map;
    Sun sun;
    float map_probability = 0.0f;  ///< probability of sampling the map instead of the sun

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

/// Samples the map or the sun, by `choice` in [0, 1); u in [0,1)^2. The lights must not be empty.
PL_HD inline FarSample sample_far(const FarLights& lights, Vec2f u, float choice) {
    if (choice < lights.map_probability) {
        FarSample sample = sample_map(lights.map, u);
        sample.pdf_sa = lights.map_probability * sample.pdf_sa +
                        (1.0f - lights.map_probability) * sun_pdf_sa(lights.sun, sample.wi);
        if (in_sun(lights.sun, sample.wi)) sample.radiance += lights.sun.radiance;
        return sample;
    }
    const Vec3f wi = sample_sun(lights.sun, u);
    // Rounding may put a direction just outside of the rim; radiance and density then both exclude the sun.
    return {.wi = wi, .radiance = far_radiance(lights, wi), .pdf_sa = far_pdf_sa(lights, wi)};
}

}  // namespace pl
