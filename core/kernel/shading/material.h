// Materials as the kernels see them: a diffuse reflector that may also emit.
#pragma once

#include <cstdint>

#include "core/kernel/base/math.h"

namespace pl {

struct Material {
    Vec3f albedo{0.0f};    ///< hemispherical reflectance
    Vec3f emission{0.0f};  ///< radiance, W m^-2 sr^-1
    std::uint32_t two_sided_emission = 0;

    PL_HD bool reflects() const { return !is_black(albedo); }
    PL_HD bool emits() const { return !is_black(emission); }
};

/// Radiance leaving a surface towards the viewer, given the side that is seen.
PL_HD inline Vec3f emitted_radiance(const Material& material, bool front) {
    return front || material.two_sided_emission != 0 ? material.emission : Vec3f{0.0f};
}

}  // namespace pl
