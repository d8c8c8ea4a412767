#include "core/io/obj.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/parallel_chunks.h"
#include "core/io/files.h"
#include "core/io/obj_library.h"
#include "core/io/obj_materials.h"
#include "core/io/obj_simple.h"
#include "core/io/obj_smooth.h"
#include "core/io/obj_triangles.h"

namespace pl {

ObjMesh read_obj_mesh(const std::filesystem::path& path) {
    const std::string text = read_text_file(path);
    std::optional<ObjMesh> simple = read_simple_obj(text, usable_threads());
    return simple ? std::move(*simple) : read_any_obj(text, path);
}

SceneDescription load_obj(const std::filesystem::path& path, MeshGroups* groups, MapKd map_kd, ObjNormals normals) {
    const int threads = usable_threads();
    ObjMesh mesh = read_obj_mesh(path);
    mesh.lengths = normals;
    smooth_normals(mesh);
    SceneDescription scene;
    scene.source = path;
    scene.files = {path};
    scene.warnings = std::move(mesh.warnings);
    const MaterialTable materials = load_materials(scene, path, mesh, map_kd);
    add_obj_triangles(scene, std::move(mesh), materials, groups, threads);
    if (scene.triangles.empty()) {
        throw Error(ErrorKind::Input, fmt::format("{}: no face has an area", path.string()));
    }
    return scene;
}

}  // namespace pl
