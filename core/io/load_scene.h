// Opening of scenes by name or by file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/load_settings.h"
#include "core/io/obj.h"
#include "core/scene/description.h"

namespace pl {

// Files that hold the surfaces of a scene, by their suffixes.

bool is_gltf(const std::filesystem::path& path);

/// Whether load_scene() opens files of a suffix: lower case, with its dot.
bool is_scene_suffix(std::string_view suffix);

/// load_gltf() or load_obj(), by the suffix. `map_kd` and `normals` are of OBJ files.
SceneDescription load_mesh(const std::filesystem::path& path, MeshGroups* groups, const LoadSettings& asked,
                           MapKd map_kd = MapKd::Multiplies, ObjNormals normals = ObjNormals::Any);

/// Opens an .obj file, a scene .json file, or a scene of assets_dir/scenes by its name; the result passes
/// validate_scene(). A scene NAME is the file scenes/NAME/NAME.json. An .obj alone gets the camera of frame_camera();
/// an up vector parallel to the viewing direction is replaced, with a warning. Knobs are applied by read_knobs(), then
/// LoadSettings::materials; meshes that emit by these are copied, see copy_emitting_meshes(). A
/// scene without light gets the light of add_default_light(), unless `asked` or its setting default-light say off; a
/// warning tells of either.
/// Throws Error(Input) if there is no such file or scene (the message names the nearest known one) or its content is
/// invalid, and Error(Usage) for an unknown knob or a value out of its range.
SceneDescription load_scene(const std::string& name_or_path, const std::filesystem::path& assets_dir,
                            const LoadSettings& asked = {});

/// The folder that contains `scenes/`: the environment variable PATHLIGHT_ASSETS if it is set, else the folder of an
/// installed program, `../share/pathlight/assets` from the program's folder, else `assets` in the program's folder or
/// one of its parents, else the folder of the source tree. Throws Error(Input) if there is none.
std::filesystem::path find_assets_dir();

/// Names of the scenes in assets_dir/scenes, sorted.
std::vector<std::string> list_scenes(const std::filesystem::path& assets_dir);

}  // namespace pl
