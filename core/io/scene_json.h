// Scene files: JSON with the schema "pathlight.scene/1".
#pragma once

#include <filesystem>

#include "core/io/json_document.h"
#include "core/io/json_file.h"
#include "core/io/load_settings.h"
#include "core/scene/description.h"

namespace pl {

// Lights without extent in scene files.

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

/// Reads a scene file and the OBJ file it names, relative to the scene file. Only `schema` and `obj` are required.
///   name         shown to people; default: the file's name
///   camera       eye, target, up, fov_deg (vertical); defaults frame the scene, level by the vertical axis. With
///                aperture_radius > 0 a thin lens focused at focus_distance, by default the distance of the target
///   cameras      cameras to choose from, see read_named_cameras(); the first is shown unless there is a `camera`
///   normals      "unit": normals of the OBJ file that are unit to within rounding are taken to the bit; else "any"
///   map_kd       "replace": an image of map_Kd alone is the albedo of an MTL entry; else "multiply": it is multiplied by Kd
///   environment  see read_environment()
///   materials    name of an MTL entry -> overrides, see read_materials()
///   knobs        see read_knobs()
///   settings     option name -> value, kept as text for the command line (true and false become on and off)
/// The vertical axis SceneDescription::up is the axis of `asked` or of the setting up-axis; else the axis nearest to
/// the camera's up; else +y for a camera with eye or target, else guess_up(). The caller sees to the default light.
/// Throws Error(Input) with file and line; for an unknown key the message names the nearest known one.
SceneDescription load_scene_json(const std::filesystem::path& path, const LoadSettings& asked = {});

}  // namespace pl
