// Lookup of the materials that the `usemtl` names of an OBJ file refer to.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/io/obj_check.h"
#include "core/scene/description.h"

namespace pl {

struct MaterialTable {
    std::vector<std::uint32_t> of_name;  ///< scene material of each name
    std::uint32_t fallback = 0;          ///< scene material of faces without a name
};

/// Loads the material libraries of the file into scene.materials and looks up `names`. Missing materials are replaced
/// by one default material, added only if faces use it, with one warning. `faces_of`: number of faces per name and,
/// last, without a name.
/// Throws Error(Input) for a library that is outside the scene's folder or malformed.
MaterialTable load_materials(SceneDescription& scene, const std::filesystem::path& obj, const CheckedObj& checked,
                             const std::vector<std::string>& names, const std::vector<std::size_t>& faces_of);

}  // namespace pl
