// Files that hold the surfaces of a scene, by their suffixes.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/io/load_settings.h"
#include "core/io/obj.h"

namespace pl {

bool is_gltf(const std::filesystem::path& path);

/// Whether load_scene() opens files of a suffix: lower case, with its dot.
bool is_scene_suffix(std::string_view suffix);

/// load_gltf() or load_obj(), by the suffix. `map_kd` and `normals` are of OBJ files.
SceneDescription load_mesh(const std::filesystem::path& path, MeshGroups* groups, const LoadSettings& asked,
                           MapKd map_kd = MapKd::Multiplies, ObjNormals normals = ObjNormals::Any);

}  // namespace pl
