// Reader of any OBJ text, by tinyobjloader.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/io/obj_mesh.h"

namespace pl {

/// Checks the text, and has the library read the text that check_obj() writes. Throws Error(Input) as check_obj() does.
ObjMesh read_any_obj(std::string_view text, const std::filesystem::path& path);

}  // namespace pl
