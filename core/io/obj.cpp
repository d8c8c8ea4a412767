#include "core/io/obj.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/parallel_chunks.h"
#include "core/io/files.h"
#include "core/io/obj_materials.h"
#include "core/io/obj_smooth.h"
#include "core/io/obj_triangles.h"
#include "core/scene/far_origin.h"

namespace pl {

namespace {

/// far_origin() of the vertices of all faces.
glm::dvec3 origin_near(const ObjMesh& mesh) {
    // The first faces of nearly all files show that these are not far away: more of them are only farther apart.
    constexpr double kNear = 0.5 * kFarAway;
    glm::dvec3 low(std::numeric_limits<double>::max());
    glm::dvec3 high(-low);
    for (const ObjFaces& part : mesh.parts) {
        for (const ObjCorner& corner : part.corners) {
            const glm::dvec3 position(mesh.positions[corner.vertex]);
            low = glm::min(low, position);
            high = glm::max(high, position);
            const glm::dvec3 sides = high - low;
            const glm::dvec3 reach = glm::max(glm::abs(low), glm::abs(high));
            if (std::max({reach.x, reach.y, reach.z}) < kNear * std::max({sides.x, sides.y, sides.z}))
                return glm::dvec3(0.0);
        }
    }
    return far_origin(low, high);
}

}  // namespace

ObjMesh read_obj_mesh(const std::filesystem::path& path) {
    const std::string text = read_text_file(path);
    ObjMesh mesh = read_obj_text(text, path, usable_threads());
    const glm::dvec3 origin = origin_near(mesh);
    return origin == glm::dvec3(0.0) ? std::move(mesh) : read_obj_text(text, path, usable_threads(), origin);
}

SceneDescription load_obj(const std::filesystem::path& path, MeshGroups* groups, MapKd map_kd, ObjNormals normals) {
    const int threads = usable_threads();
    ObjMesh mesh = read_obj_mesh(path);
    mesh.lengths = normals;
    smooth_normals(mesh);
    SceneDescription scene;
    scene.source = path;
    scene.files = {path};
    scene.origin = mesh.origin;
    scene.warnings = std::move(mesh.warnings);
    tell_origin(scene);
    const MaterialTable materials = load_materials(scene, path, mesh, map_kd);
    add_obj_triangles(scene, std::move(mesh), materials, groups, threads);
    if (scene.triangles.empty()) {
        throw Error(ErrorKind::Input, fmt::format("{}: no face has an area", path.string()));
    }
    return scene;
}

}  // namespace pl
