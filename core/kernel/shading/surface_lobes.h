// Lobes of non-diffuse surfaces. An array beside the materials, empty for scenes with diffuse surfaces only.
#pragma once

#include <cstdint>

#include "core/kernel/base/math.h"

namespace pl {

enum class SurfaceKind : std::uint32_t {
    Diffuse,     ///< Lambert
    Conductor,   ///< metal, smooth or rough
    Dielectric,  ///< glass, water, smooth or rough: reflection and refraction
    Plastic,     ///< Lambert base under a smooth or rough dielectric coat
    Pane,        ///< thin sheet of clear glass: reflects, and lets light straight through
    Velvet,      ///< Lambert base under fibers that reflect towards the horizon
};

struct SurfaceLobes {
    SurfaceKind kind = SurfaceKind::Diffuse;
    float roughness = 0.0f;    ///< in [0, 1]: sqrt(alpha) of GGX, or of SheenFibers; 0: delta lobes
    float ior = 1.5f;          ///< index of refraction, inside over outside
    std::uint32_t table = 0;   ///< offset in SceneView::directional_albedo, see AlbedoTable
    Vec3f specular{1.0f};      ///< conductor: reflectance at normal incidence; others: tint of the reflection
    Vec3f transmission{1.0f};  ///< dielectric and pane: tint of the transmission; conductor: 1 - edge_loss()

    /// Of a conductor, see fresnel_conductor(); 0: none. Shares the place of the transmission, so that no surface pays for both.
    PL_HD Vec3f edge_loss() const { return Vec3f{1.0f} - transmission; }
};

/// The anisotropy of a rough metal: microfacets that are wider along one direction than across it, see anisotropy.h. Isotropic by default.
struct MaterialAnisotropy {
    /// Width along the wider direction over the geometric mean of both widths. The roughness is the root of this
    /// mean.
    float stretch = 1.0f;
    float ratio = 1.0f;  ///< of the width across to the width along, in (0, 1]
    /// Roughness of the isotropic facets that reflect as much, over the roughness of the material.
    float table_stretch = 1.0f;
    float cosine = 1.0f;  ///< of the angle from the direction of u towards the direction of v
    float sine = 0.0f;
};

}  // namespace pl
