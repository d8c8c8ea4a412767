// Reader of any OBJ text, by tinyobjloader.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/io/obj_mesh.h"

namespace pl {

/// Checks the text, and has the library read what check_obj() makes of it. Throws Error(Input) as check_obj() does.
ObjMesh read_any_obj(std::string_view text, const std::filesystem::path& path);

}  // namespace pl
