// Loader of Wavefront OBJ with its MTL files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/io/load_settings.h"
#include "core/io/mtl_entry.h"
#include "core/io/obj_mesh.h"
#include "core/scene/description.h"

namespace pl {

// Lookup of the materials that the `usemtl` names of an OBJ file refer to.

struct MaterialTable {
    std::vector<std::uint32_t> of_name;  ///< scene material of each name
    std::uint32_t fallback = 0;          ///< scene material of faces without a name
    std::vector<UvScale> uvs{};          ///< by scene material; those behind the end have theirs as they are

    /// Scene material of a run of faces.
    std::uint32_t of(const ObjFaces::Run& run) const {
        return run.material == ObjFaces::kNoMaterial ? fallback : of_name[run.material];
    }
};

/// Loads the material libraries of the file into scene.materials and looks up the names that it uses. Missing materials
/// are replaced by one default material, added only if faces use it, with one warning, which tells of libraries that cannot be read, too.
MaterialTable load_materials(SceneDescription& scene, const std::filesystem::path& obj, const ObjMesh& mesh,
                             MapKd map_kd);

/// Groups of the triangles of a scene, by the last `o` or `g` statement before the face. The whole statement is the
/// name.
struct MeshGroups {
    std::vector<std::string> names;            ///< the first is empty: faces before any statement
    std::vector<std::uint32_t> of_triangle{};  ///< index into `names`, parallel to SceneDescription::triangles
};

/// The elements of the file, with no look at its materials. The elements of faces far from the origin are read again
/// from an origin near the faces. Throws Error(Input) as load_obj() does.
ObjMesh read_obj_mesh(const std::filesystem::path& path);

/// Reads geometry and materials; the caller sets camera and name.
/// - `v`, `vn`, `vt`, `f` (triangles and polygons, negative indices), `usemtl`, `mtllib`; groups and objects are
///   merged, and listed in `groups` if it is not null.
/// - Corners share a vertex exactly if they share its index, so watertight meshes stay watertight.
/// - Faces without a material get a default one with kDefaultAlbedo, with one warning for the whole scene.
/// - Faces of a smoothing group (`s`) without normals get the normals of smooth_normals().
/// - Triangles too small to have a normal are removed; normals of length 0, or missing at a corner of a triangle, are
///   ignored; each with one counted warning. A triangle with a corner without texture coordinates has none.
/// - Files that it names are looked for as find_named_file() does.
/// - Geometry far from the origin is moved near it, with a warning.
/// What cannot be used is left out, with one counted warning of each kind. Throws Error(Input) if there is no face with an area.
SceneDescription load_obj(const std::filesystem::path& path, MeshGroups* groups = nullptr,
                          MapKd map_kd = MapKd::Multiplies, ObjNormals normals = ObjNormals::Any);

}  // namespace pl
