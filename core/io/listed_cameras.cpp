#include "core/io/listed_cameras.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.h"
#include "core/io/frame_camera.h"

namespace pl {
namespace {

void use(std::size_t index, SceneDescription& scene) {
    scene.camera = scene.cameras[index].camera;
    scene.chosen_camera = static_cast<std::uint32_t>(index + 1);
}

std::string camera_names(const SceneDescription& scene) {
    std::vector<std::string> names;
    for (const NamedCamera& camera : scene.cameras)
        names.push_back(fmt::format("{} '{}'", names.size() + 1, camera.name));
    return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

/// Index of a camera by its name, else by its number from 1.
std::size_t find_camera(const std::string& asked, const SceneDescription& scene) {
    for (std::size_t i = 0; i < scene.cameras.size(); ++i)
        if (scene.cameras[i].name == asked) return i;
    for (std::size_t i = 0; i < scene.cameras.size(); ++i)
        if (std::to_string(i + 1) == asked) return i;
    throw Error(
        ErrorKind::Usage,
        fmt::format("--camera {}: expected a camera .json file, or one of the cameras that {} lists, got none of "
                    "them: {}",
                    asked, scene.source.string(), camera_names(scene)));
}

}  // namespace

std::string size_of_aspect(float aspect) {
    constexpr float kHeight = 512.0f;
    return fmt::format("{:.0f}x{:.0f}", kHeight * std::clamp(aspect, 0.25f, 4.0f), kHeight);
}

void set_default_camera(SceneDescription& scene) {
    if (scene.cameras.empty())
        scene.camera = frame_camera(scene);
    else
        use(0, scene);
}

void choose_camera(const std::string& asked, SceneDescription& scene) {
    if (!asked.empty()) use(find_camera(asked, scene), scene);
    const float aspect = scene.chosen_camera > 0 ? scene.cameras[scene.chosen_camera - 1].aspect : 0.0f;
    if (aspect > 0.0f && scene.setting("size").empty()) scene.settings.emplace_back("size", size_of_aspect(aspect));
}

}  // namespace pl
