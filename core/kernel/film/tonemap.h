// Tone curves and sRGB encoding. Display only: measurements use linear radiance.
#pragma once

#include <cstdint>

#include "core/kernel/base/math.h"

namespace pl {

enum class ToneCurve : std::uint32_t { Clamp, Reinhard, Aces };

/// Display color of NaN: magenta.
inline constexpr float kInvalidMarker[3] = {1.0f, 0.0f, 1.0f};

/// One channel of non-negative exposed radiance to [0, 1]; monotone, infinity gives 1.
PL_HD inline float apply_curve(ToneCurve curve, float x) {
    if (!(x > 0.0f)) return 0.0f;
    switch (curve) {
    case ToneCurve::Clamp: return min_of(x, 1.0f);
    case ToneCurve::Reinhard: return 1.0f - 1.0f / (1.0f + x);
    case ToneCurve::Aces: {
        // Fit of the ACES filmic curve [Narkowicz 2016]; clamped, because y * y could overflow.
        const float y = min_of(x, 1.0e4f);
        return clamp_to((y * (2.51f * y + 0.03f)) / (y * (2.43f * y + 0.59f) + 0.14f), 0.0f, 1.0f);
    }
    }
    return 0.0f;
}

/// Linear display value in [0,1]^3, magenta for NaN; `exposure_scale` is 2^EV.
PL_HD inline Vec3f tone_map(Vec3f radiance, float exposure_scale, ToneCurve curve) {
    if (radiance.x != radiance.x || radiance.y != radiance.y || radiance.z != radiance.z)
        return {kInvalidMarker[0], kInvalidMarker[1], kInvalidMarker[2]};
    return {apply_curve(curve, radiance.x * exposure_scale), apply_curve(curve, radiance.y * exposure_scale),
            apply_curve(curve, radiance.z * exposure_scale)};
}

/// Linear value in [0,1] to sRGB-encoded [0,1].   [IEC 61966-2-1]
PL_HD inline float encode_srgb(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

}  // namespace pl
