// Makes the tables of core/kernel/shading/directional_albedo.h.
#pragma once

#include <vector>

#include "core/kernel/shading/directional_albedo.h"

namespace pl {

/// What single reflections return where facets reflect everything: [AlbedoTable::kSize] values in [0, 1].
std::vector<float> lossless_albedo();

/// What single reflections return where facets are a dielectric's, by Fresnel's equations; `eta` as in fresnel_dielectric().
std::vector<float> coat_albedo(float eta);

/// What single reflections and refractions through such facets return together.
std::vector<float> glass_albedo(float eta);

}  // namespace pl
