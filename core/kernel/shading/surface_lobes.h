// What a surface does to light besides reflecting it as Lambert's law says. Kept beside the materials: a scene without such
// surfaces has none of it.
#pragma once

#include <cstdint>

#include "core/kernel/base/math.h"

namespace pl {

enum class SurfaceKind : std::uint32_t {
    Diffuse,     ///< Lambert
    Conductor,   ///< reflects as a metal does, smooth or rough
    Dielectric,  ///< reflects and refracts, smooth or rough: glass, water
    Plastic,     ///< Lambert under a smooth or rough dielectric coat
};

struct SurfaceLobes {
    SurfaceKind kind = SurfaceKind::Diffuse;
    float roughness = 0.0f;    ///< in [0, 1]: root of the width alpha of GGX; 0: lobes of a single direction
    float ior = 1.5f;          ///< index of refraction inside over that outside
    std::uint32_t table = 0;   ///< of directional albedos, see directional_albedo.h
    Vec3f specular{1.0f};      ///< conductor: reflectance at normal incidence; others: tint of what is reflected
    Vec3f transmission{1.0f};  ///< dielectric: tint of what passes
};

}  // namespace pl
