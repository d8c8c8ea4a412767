// Which material of the scene a `usemtl` name of an OBJ file means.
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

/// Loads the file's material libraries into scene.materials and looks up `names`. Whatever is missing is replaced
/// by one default material, added only if faces need it, with one warning. `faces_of` counts the faces of each
/// name and, at its end, those without a name.
/// Throws Error(Input): a library outside the scene's folder, or malformed.
MaterialTable load_materials(SceneDescription& scene, const std::filesystem::path& obj, const CheckedObj& checked,
                             const std::vector<std::string>& names, const std::vector<std::size_t>& faces_of);

}  // namespace pl
