#include "core/io/obj_materials.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "core/io/files.h"
#include "core/io/line_reader.h"
#include "core/io/mtl.h"

namespace pl {

namespace fs = std::filesystem;

namespace {

/// Path of an `mtllib` argument, which must stay in the scene's folder.
fs::path library_path(const fs::path& obj, const std::string& name, int line) {
    const fs::path relative(name);
    if (!stays_inside(obj.parent_path(), relative)) {
        fail_at(obj, line,
                fmt::format("'mtllib': expected a file in the folder of the scene, got {}", in_quotes(name)));
    }
    return obj.parent_path() / relative;
}

bool is_there(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path, ignored);
}

/// One name with blanks if such a file exists, else one name per word.
std::vector<std::string> library_names(const fs::path& obj, const ObjName& library) {
    if (!library.name.empty() && is_there(library_path(obj, library.name, library.line))) {
        return {library.name};
    }
    const std::vector<std::string_view> words = split_words(library.name);
    return {words.begin(), words.end()};
}

/// Loads all libraries into the scene. Returns the missing ones, for the warning about materials.
std::vector<std::string> load_libraries(SceneDescription& scene, const fs::path& obj, const ObjMesh& mesh,
                                        MapKd map_kd) {
    std::vector<std::string> missing;
    std::set<std::string> seen;
    for (const ObjName& library : mesh.libraries) {
        for (const std::string& name : library_names(obj, library)) {
            const fs::path path = library_path(obj, name, library.line);
            if (!seen.insert(name).second) {
                continue;
            }
            scene.files.push_back(path);
            if (!is_there(path)) {
                missing.push_back(
                    fmt::format("{}: material file {} not found", place(obj, library.line), in_quotes(name)));
                continue;
            }
            load_mtl(path, scene, map_kd);
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
    std::vector<std::string> reasons = load_libraries(scene, obj, mesh, map_kd);
    std::map<std::string, std::uint32_t> known;
    for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
        known.try_emplace(scene.materials[i].name, i);
    }
    MaterialTable table{.of_name = {}, .fallback = static_cast<std::uint32_t>(scene.materials.size())};
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
