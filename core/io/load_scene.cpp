#include "core/io/load_scene.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include <fmt/format.h>
#include <sys/auxv.h>

#include "core/base/error.h"
#include "core/io/camera_file.h"
#include "core/io/files.h"
#include "core/io/gltf/gltf.h"
#include "core/io/kept_meshes.h"
#include "core/io/mitsuba/mitsuba.h"
#include "core/io/nearest_name.h"
#include "core/io/scene_json.h"
#include "core/io/scene_knobs.h"
#include "core/io/scene_materials.h"
#include "core/scene/blends.h"
#include "core/scene/default_light.h"
#include "core/scene/float_range.h"
#include "core/scene/up_axis.h"
#include "core/scene/validate.h"

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

namespace fs = std::filesystem;

namespace {

fs::path scene_file(const fs::path& assets_dir, const std::string& name) {
    return assets_dir / "scenes" / name / (name + ".json");
}

bool is_file(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

bool has_scenes(const fs::path& dir) {
    std::error_code ignored;
    return fs::is_directory(dir / "scenes", ignored);
}

SceneDescription load_file(const fs::path& path, const LoadSettings& asked) {
    if (suffix_of(path) == ".json") {
        return load_scene_json(path, asked);
    }
    if (suffix_of(path) == ".xml") {
        SceneDescription scene = load_mitsuba(path, asked);
        scene.name = path.stem().string();
        scene.up = asked.up_axis ? up_direction(*asked.up_axis, scene) : scene.up;
        if (scene.cameras.empty()) {
            set_default_camera(scene);
        }
        return scene;
    }
    SceneDescription scene = load_mesh(path, nullptr, asked);
    scene.name = path.stem().string();
    const UpAxis standard = is_gltf(path) ? UpAxis::Y : UpAxis::Auto;
    scene.up = up_direction(asked.up_axis.value_or(standard), scene);
    set_default_camera(scene);
    return scene;
}

/// glTF files leave the light to the viewer: surfaces whose emission is at most 1, such as labels and displays, light nothing.
bool only_glows(const fs::path& path, const SceneDescription& scene) {
    const auto glows = [](const MaterialDescription& material) {
        return glm::all(glm::lessThanEqual(material.emission, glm::vec3(1.0f)));
    };
    return is_gltf(path) && scene.environment == glm::vec3(0.0f) && scene.environment_map.texels.empty() &&
           scene.sun.radiance == glm::vec3(0.0f) && scene.punctual_lights.empty() &&
           std::all_of(scene.materials.begin(), scene.materials.end(), glows);
}

/// Lights a scene that has no light, or says that it stays black.
void see_to_light(const fs::path& path, const LoadSettings& asked, SceneDescription& scene) {
    const bool is_dark = light_of(scene) == SceneLight::None;
    if (!is_dark && !only_glows(path, scene)) {
        return;
    }
    const bool is_on = asked.default_light.value_or(scene.setting("default-light") != "off");
    if (is_on) {
        add_default_light(scene);
    } else if (!is_dark) {
        return;
    }
    scene.warnings.push_back(fmt::format("{}: no light in this scene{}{}", scene.source.string(),
                                         is_dark ? "" : " but surfaces that glow",
                                         is_on ? "; by " + light_text(scene) + " (--default-light off: without)"
                                               : ": the picture is black (--default-light on: a sky with a sun)"));
}

/// Number of triangles without texture coordinates that show a material for which a predicate is true.
template <class Predicate>
auto count_without_uvs(const SceneDescription& scene, Predicate&& predicate) {
    return std::ranges::count_if(scene.triangles, [&](const TriangleDescription& t) {
        return t.uv.x == TriangleDescription::kNoUv && any_shown(scene.materials, t.material, predicate);
    });
}

/// Without texture coordinates a triangle shows a single point of the image, and facets have no direction of their own.
void warn_of_missing_uvs(SceneDescription& scene) {
    const auto count = count_without_uvs(scene, [](const auto& material) { return material.textures.any(); });
    if (count > 0) {
        scene.warnings.push_back(fmt::format("{}: {} triangles have a texture but no texture coordinates: they show "
                                             "the point (0, 0) of it",
                                             scene.source.string(), count));
    }
    const auto undirected = count_without_uvs(scene, [](const auto& material) { return material.is_anisotropic(); });
    if (undirected > 0) {
        scene.warnings.push_back(
            fmt::format("{}: {} triangles are anisotropic but have no texture coordinates: their "
                        "normals alone decide the direction",
                        scene.source.string(), undirected));
    }
}

[[noreturn]] void fail_unknown(const std::string& name, const fs::path& assets_dir) {
    std::error_code ignored;
    if (fs::exists(name, ignored)) {
        throw Error(
            ErrorKind::Input,
            fmt::format(
                "{}: expected an .obj, .gltf, .glb or Mitsuba .xml file, a scene .json file or the name of a scene",
                name));
    }
    const std::vector<std::string> known = list_scenes(assets_dir);
    const std::string hint = known.empty() ? "" : known_names(name, known);
    throw Error(ErrorKind::Input, fmt::format("no scene '{}'{}", name, hint));
}

}  // namespace

SceneDescription load_scene(const std::string& name_or_path, const fs::path& assets_dir, const LoadSettings& asked) {
    const std::string extension = suffix_of(name_or_path);
    const bool is_path = is_scene_suffix(extension);
    const bool is_name = !is_path && !name_or_path.empty() && name_or_path.find('/') == std::string::npos;
    const fs::path path = is_path ? fs::path(name_or_path) : scene_file(assets_dir, name_or_path);
    if (!is_path && !(is_name && is_file(path))) {
        fail_unknown(name_or_path, assets_dir);
    }
    SceneDescription scene = load_file(path, asked);
    choose_camera(asked.camera, scene);
    if (suffix_of(path) != ".xml") require_known_knobs(scene, asked.parameters);
    if (!asked.materials.empty()) {
        read_material_file(asked.materials, scene);
    }
    copy_emitting_meshes(scene);
    validate_scene(scene);
    if (move_into_float_range(scene)) validate_scene(scene);
    warn_of_float_steps(scene);
    warn_of_missing_uvs(scene);
    const glm::vec3 up = usable_up(scene.camera);
    if (up != scene.camera.up) {
        scene.camera.up = up;
        scene.warnings.push_back(fmt::format("{}: the camera's up vector is along its view, replaced by {} {} {}",
                                             scene.source.string(), up.x, up.y, up.z));
    }
    see_to_light(path, asked, scene);
    return scene;
}

fs::path find_assets_dir() {
    if (const char* const named = std::getenv("PATHLIGHT_ASSETS"); named != nullptr && *named != '\0') {
        if (!has_scenes(named)) {
            throw Error(ErrorKind::Input,
                        fmt::format("PATHLIGHT_ASSETS={}: expected a folder that has 'scenes'", named));
        }
        return named;
    }
    std::error_code ignored;
    fs::path program = fs::read_symlink("/proc/self/exe", ignored);
    if (program.empty()) {
        // A chroot may lack /proc; the kernel also tells by which path it has started the program.
        program = fs::absolute(reinterpret_cast<const char*>(getauxval(AT_EXECFN)), ignored);
    }
    // Installed as PREFIX/bin/pathlight, wherever PREFIX has been moved to.
    if (const fs::path installed = program.parent_path().parent_path() / "share" / "pathlight" / "assets";
        has_scenes(installed)) {
        return installed;
    }
    for (fs::path dir = program.parent_path(); !dir.empty(); dir = dir.parent_path()) {
        if (has_scenes(dir / "assets")) {
            return dir / "assets";
        }
        if (dir == dir.root_path()) {
            break;
        }
    }
    if (!has_scenes(PL_ASSETS_DIR)) {
        throw Error(ErrorKind::Input, fmt::format("no folder 'assets' at or above {}: set PATHLIGHT_ASSETS",
                                                  program.parent_path().string()));
    }
    return PL_ASSETS_DIR;
}

std::vector<std::string> list_scenes(const fs::path& assets_dir) {
    std::vector<std::string> names;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(assets_dir / "scenes", ignored)) {
        const std::string name = entry.path().filename().string();
        if (is_file(scene_file(assets_dir, name))) {
            names.push_back(name);
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace pl
