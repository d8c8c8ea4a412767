// Computes the tables of core/kernel/shading/directional_albedo.h.
#pragma once

#include <vector>

#include "core/kernel/shading/directional_albedo.h"

namespace pl {

/// Directional albedo by single reflection for facets of reflectance 1: [AlbedoTable::kSize] values in [0, 1].
std::vector<float> lossless_albedo();

/// Directional albedo by single reflection for dielectric facets; `eta` as in fresnel_dielectric().
std::vector<float> coat_albedo(float eta);

/// Directional albedo by single reflection and refraction for dielectric facets.
std::vector<float> glass_albedo(float eta);

/// Directional albedo of the fibers of velvet, good to 3e-4 between the entries, for roughnesses from SheenFibers::kLeastRoughness on.
std::vector<float> sheen_albedo();

}  // namespace pl
