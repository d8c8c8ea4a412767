// Lights without extent in scene files.
#pragma once

#include "core/io/json_document.h"
#include "core/io/json_file.h"
#include "core/scene/description.h"

namespace pl {

/// Reads the array `lights`, of objects with the members
///   type          "point", "spot" or "directional"
///   position      [x, y, z], of points and spots
///   direction     [x, y, z] in which the light travels, of spots and directional lights
///   intensity     [r, g, b] of points and spots, W/sr
///   irradiance    [r, g, b] of directional lights: of a surface that faces them, W/m^2
///   inner_deg, outer_deg    half angles of a spot's cones: full intensity inside of the inner one, none outside of the outer one; equal for a hard edge
///   falloff       "cosine" (default) or "angle", see SpotFalloff
/// Throws Error(Input) with file and line.
void read_punctual_lights(const JsonDocument& file, SceneDescription& scene);

/// A light for read_punctual_lights().
Json punctual_light_json(const PunctualLightDescription& light);

}  // namespace pl
