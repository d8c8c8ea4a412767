// Materials as the kernels see them: diffuse reflectance and emission. SurfaceLobes has the other lobes.
#pragma once

#include <cstdint>

#include "core/kernel/base/math.h"

namespace pl {

struct Material {
    Vec3f albedo{0.0f};    ///< hemispherical reflectance, each channel in [0, 1]
    Vec3f emission{0.0f};  ///< radiance, W m^-2 sr^-1
    std::uint32_t two_sided_emission = 0;

    PL_HD bool reflects() const { return !is_black(albedo); }
    PL_HD bool emits() const { return !is_black(emission); }
};

/// Emitted radiance of the front or back side.
PL_HD inline Vec3f emitted_radiance(const Material& material, bool front) {
    return front || material.two_sided_emission != 0 ? material.emission : Vec3f{0.0f};
}

}  // namespace pl
