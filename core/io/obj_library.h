// Reader of any OBJ text, by tinyobjloader.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/io/obj_mesh.h"

namespace pl {

/// Checks the text, and has the library read the text that check_obj() writes. Faces that use a vertex without usable numbers or that is
/// not there are left out; so are the normals and texture points of a face if one of them is of this kind. Each with one counted warning.
/// Throws Error(Input) as check_obj() does, and if there is no usable face.
/// `origin`: that of the mesh.
ObjMesh read_any_obj(std::string_view text, const std::filesystem::path& path,
                     const glm::dvec3& origin = glm::dvec3(0.0));

}  // namespace pl
