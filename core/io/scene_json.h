// Scene files: JSON with the schema "pathlight.scene/1".
#pragma once

#include <filesystem>

#include "core/scene/description.h"

namespace pl {

/// Reads a scene file and the OBJ file it names, relative to the scene file. Only `schema` and `obj` are required.
///   name         shown to people; default: the file's name
///   camera       eye, target, up, fov_deg (vertical); what is missing frames the scene. aperture_radius must be 0
///   environment  radiance [r, g, b]; maps are refused
///   materials    name of an MTL entry -> albedo [r, g, b], emission [r, g, b], two_sided_emission
///   settings     option name -> value, kept as text for the command line (true and false become on and off)
/// Throws Error(Input) with file and line; an unknown key is answered with the nearest known one.
SceneDescription load_scene_json(const std::filesystem::path& path, const KnobValues& knobs = {});

}  // namespace pl
