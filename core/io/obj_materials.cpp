#include "core/io/obj_materials.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/io/line_reader.h"
#include "core/io/mtl.h"
#include "core/io/obj_names.h"

namespace pl {

namespace fs = std::filesystem;

namespace {

/// One name with blanks if such a file exists, else all names of the statement.
std::vector<std::string> names_of(const fs::path& folder, const std::string& arguments) {
    const std::string whole(unquoted(arguments));
    const NamedFile file = find_named_file(folder, {}, whole);
    return file.is_there && !file.is_elsewhere ? std::vector{whole} : library_names(arguments);
}

/// Loads all libraries into the scene. Returns those that cannot be read with the reasons, for the warning about materials.
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

}  // namespace pl
