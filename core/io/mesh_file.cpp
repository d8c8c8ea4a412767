#include "core/io/mesh_file.h"

#include "core/io/files.h"
#include "core/io/gltf/gltf.h"

namespace pl {
namespace {

bool is_gltf_suffix(std::string_view suffix) { return suffix == ".gltf" || suffix == ".glb"; }

}  // namespace

bool is_gltf(const std::filesystem::path& path) { return is_gltf_suffix(suffix_of(path)); }

bool is_scene_suffix(std::string_view suffix) {
    return suffix == ".obj" || suffix == ".json" || suffix == ".xml" || is_gltf_suffix(suffix);
}

SceneDescription load_mesh(const std::filesystem::path& path, MeshGroups* groups, const LoadSettings& asked,
                           MapKd map_kd, ObjNormals normals) {
    return is_gltf(path) ? load_gltf(path, groups, asked.most_copied_triangles)
                         : load_obj(path, groups, map_kd, normals);
}

}  // namespace pl
