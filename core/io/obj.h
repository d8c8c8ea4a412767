// Wavefront OBJ with its MTL files, through tinyobjloader.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/description.h"

namespace pl {

/// Which group each triangle of a scene belongs to: that of the last `o` or `g` statement before its face; all of the
/// statement is the name.
struct MeshGroups {
    std::vector<std::string> names;            ///< the first one is empty: faces before any statement
    std::vector<std::uint32_t> of_triangle{};  ///< index into `names`, parallel to SceneDescription::triangles
};

/// Reads geometry and materials; the camera and the name are left to the caller.
/// - `v`, `vn`, `vt`, `f` (triangles and polygons, negative indices), `usemtl`, `mtllib`; groups and objects are merged in
///   the scene, and told apart in `groups` if it is not null.
/// - Corners share a vertex exactly when they share its index: what is watertight in the file stays so.
/// - Faces without a material get a default one, of color kDefaultAlbedo, with one warning for the whole scene.
/// - Triangles too small to have a normal are removed; normals of no length, or missing at one of a triangle's
///   corners, are ignored; each with one counted warning. Texture points missing at a corner are ignored for the triangle.
/// - `mtllib` may only name files in the folder of the OBJ file or below.
/// Throws Error(Input) with file and line for what is malformed; see check_obj() and load_mtl().
SceneDescription load_obj(const std::filesystem::path& path, MeshGroups* groups = nullptr);

}  // namespace pl
