// The mesh of a scene as OBJ and MTL text.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/description.h"

namespace pl {

/// A name for each material, all different, that OBJ, MTL and JSON text hold as it is: printable characters without '#'
/// and '\', single blanks inside. Names that are such already stay.
std::vector<std::string> material_names(const SceneDescription& scene);

/// Writes FOLDER/STEM.obj and .mtl. With ObjNormals::Unit, load_obj() reads positions, normals, texture points and triangles to
/// the bit, and the materials in their order, of which the MTL file has only the color. Throws Error(Runtime).
void write_mesh(const SceneDescription& scene, const std::vector<std::string>& names,
                const std::filesystem::path& folder, const std::string& stem);

}  // namespace pl
