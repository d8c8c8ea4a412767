#include "core/io/obj.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/io/files.h"
#include "core/io/line_reader.h"
#include "core/io/mtl.h"
#include "core/io/obj_names.h"
#include "core/io/obj_triangles.h"
#include "core/scene/far_origin.h"

namespace pl {

namespace fs = std::filesystem;

namespace {

/// One name with blanks if such a file exists, else all names of the statement.
std::vector<std::string> names_of(const fs::path& folder, const std::string& arguments) {
    const std::string whole(unquoted(arguments));
    const NamedFile file = find_named_file(folder, {}, whole);
    return file.is_there && !file.is_elsewhere ? std::vector{whole} : library_names(arguments);
}

/// Loads all libraries into the scene. Returns the libraries that cannot be read, with the reasons, for the warning
/// about materials.
std::vector<std::string> load_libraries(SceneDescription& scene, const fs::path& obj, const ObjMesh& mesh,
                                        MapKd map_kd, std::vector<UvScale>& uvs) {
    std::vector<std::string> missing;
    std::set<fs::path> seen;
    const fs::path folder = obj.parent_path();
    for (const ObjName& library : mesh.libraries) {
        for (const std::string& name : names_of(folder, library.name)) {
            const NamedFile file = find_named_file(folder, {}, name);
            if (!seen.insert(file.path).second) {
                continue;
            }
            scene.files.push_back(file.path);
            const std::string told = fmt::format("{}: material file {}", place(obj, library.line), in_quotes(name));
            if (!file.is_there) {
                missing.push_back(told + (file.is_elsewhere ? " is outside of the scene's folder, where none of its "
                                                              "name is"
                                                            : " not found"));
                continue;
            }
            if (file.is_elsewhere) {
                scene.warnings.push_back(fmt::format("{} is not there: {} is read", told, file.path.string()));
            }
            try {
                const std::vector<UvScale> of_file = load_mtl(file.path, scene, map_kd);
                uvs.insert(uvs.end(), of_file.begin(), of_file.end());
            } catch (const MemoryError&) {
                throw;
            } catch (const Error& error) {
                if (error.kind() != ErrorKind::Input) throw;
                missing.emplace_back(error.what());
            }
        }
    }
    return missing;
}

std::string describe(const std::vector<std::string>& reasons, const fs::path& obj) {
    if (reasons.empty()) {
        return obj.string() + ": no material given";
    }
    constexpr std::size_t kMostShown = 5;
    const std::size_t shown = std::min(reasons.size(), kMostShown);
    std::string text = reasons[0];
    for (std::size_t i = 1; i < shown; ++i) {
        text += "; " + reasons[i];
    }
    return shown == reasons.size() ? text : fmt::format("{}; and {} more", text, reasons.size() - shown);
}

std::size_t faces_of(const ObjMesh& mesh, const MaterialTable& table, std::uint32_t material) {
    std::size_t faces = 0;
    for (const ObjFaces& part : mesh.parts) {
        for (std::size_t run = 0; run < part.runs.size(); ++run) {
            faces += table.of(part.runs[run]) == material ? part.end_of(run) - part.runs[run].first : 0;
        }
    }
    return faces;
}

}  // namespace

MaterialTable load_materials(SceneDescription& scene, const fs::path& obj, const ObjMesh& mesh, MapKd map_kd) {
    std::vector<UvScale> uvs;
    std::vector<std::string> reasons = load_libraries(scene, obj, mesh, map_kd, uvs);
    std::map<std::string, std::uint32_t> known;
    for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
        known.try_emplace(scene.materials[i].name, i);
    }
    MaterialTable table{
        .of_name = {}, .fallback = static_cast<std::uint32_t>(scene.materials.size()), .uvs = std::move(uvs)};
    for (const ObjName& used : mesh.materials) {
        const auto found = known.find(used.name);
        table.of_name.push_back(found == known.end() ? table.fallback : found->second);
        if (found == known.end()) {
            reasons.push_back(fmt::format("{}: no material {}", place(obj, used.line), in_quotes(used.name)));
        }
    }
    const std::size_t faces = faces_of(mesh, table, table.fallback);
    if (faces > 0) {
        scene.materials.push_back({.name = "default", .albedo = kDefaultAlbedo});
    }
    if (faces > 0 || !reasons.empty()) {
        scene.warnings.push_back(
            fmt::format("{}; {} faces are shown in the default color", describe(reasons, obj), faces));
    }
    return table;
}

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
