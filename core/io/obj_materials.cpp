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
    if (!stays_inside(relative)) {
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
std::vector<std::string> library_names(const fs::path& obj, const MaterialLibraries& library) {
    if (!library.names.empty() && is_there(library_path(obj, library.names, library.line))) {
        return {library.names};
    }
    const std::vector<std::string_view> words = split_words(library.names);
    return {words.begin(), words.end()};
}

/// Loads all libraries into the scene. Returns the missing ones, for the warning about materials.
std::vector<std::string> load_libraries(SceneDescription& scene, const fs::path& obj, const CheckedObj& checked) {
    std::vector<std::string> missing;
    std::set<std::string> seen;
    for (const MaterialLibraries& library : checked.libraries) {
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
            load_mtl(path, scene);
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

}  // namespace

MaterialTable load_materials(SceneDescription& scene, const fs::path& obj, const CheckedObj& checked,
                             const std::vector<std::string>& names, const std::vector<std::size_t>& faces_of) {
    std::vector<std::string> reasons = load_libraries(scene, obj, checked);
    std::map<std::string, std::uint32_t> known;
    for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
        known.try_emplace(scene.materials[i].name, i);
    }
    MaterialTable table{.of_name = {}, .fallback = static_cast<std::uint32_t>(scene.materials.size())};
    std::size_t faces = faces_of.back();
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto found = known.find(names[i]);
        table.of_name.push_back(found == known.end() ? table.fallback : found->second);
        if (found == known.end()) {
            faces += faces_of[i];
            reasons.push_back(fmt::format("{}: no material {}", place(obj, checked.material_lines.at(names[i])),
                                          in_quotes(names[i])));
        }
    }
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
