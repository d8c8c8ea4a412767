// Anisotropic facets by their numbers in files.
#pragma once

#include "core/kernel/shading/surface_lobes.h"
#include "core/scene/description.h"

namespace pl {

/// Of MaterialDescription::anisotropy and rotation_deg.
MaterialAnisotropy pack_anisotropy(float anisotropy, float rotation_deg);

/// The warning of loaders where set_widths() returns false.
inline constexpr const char* kWidestFacets =
    "facets more than 100 times as wide one way as the other are shown as 100 times as wide";

/// Gives a conductor the widths, at least 0, of facets along the direction of u and along the direction of v. Returns
/// whether the conductor has exactly these widths: where they differ more than kMostAnisotropy allows, the smaller
/// one grows.
bool set_widths(MaterialDescription& material, float along_u, float along_v);

}  // namespace pl
