// Lookup of the materials that the `usemtl` names of an OBJ file refer to.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/io/map_kd.h"
#include "core/io/mtl_entry.h"
#include "core/io/obj_mesh.h"
#include "core/scene/description.h"

namespace pl {

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

}  // namespace pl
