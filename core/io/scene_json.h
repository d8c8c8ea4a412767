// Scene files: JSON with the schema "pathlight.scene/1".
#pragma once

#include <filesystem>

#include "core/scene/description.h"

namespace pl {

/// Reads a scene file and the OBJ file it names, relative to the scene file. Only `schema` and `obj` are required.
///   name         shown to people; default: the file's name
///   camera       eye, target, up, fov_deg (vertical); what is missing frames the scene. With an aperture_radius
///                above 0 it is a lens that is sharp at focus_distance, by default that of the target
///   environment  see read_environment()
///   materials    name of an MTL entry -> overrides, see read_materials()
///   knobs        see read_knobs()
///   settings     option name -> value, kept as text for the command line (true and false become on and off)
/// Throws Error(Input) with file and line; an unknown key is answered with the nearest known one.
SceneDescription load_scene_json(const std::filesystem::path& path, const KnobValues& knobs = {});

}  // namespace pl
