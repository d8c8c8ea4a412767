// Scenes by name or by file: the way every part of the program opens one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/description.h"

namespace pl {

/// Opens an .obj file, a scene .json file, or a scene of assets_dir/scenes by its name; the result is valid in the
/// sense of validate_scene(). A scene NAME is the file scenes/NAME/NAME.json. An .obj alone gets a camera that
/// frames it, and a camera whose up vector is along the view gets another one, with a warning.
/// `knobs` are turned as read_knobs() says.
/// Throws Error(Input): no such file or scene (the nearest known name is told), or its content is not valid;
/// Error(Usage): a knob that it does not have, or a value that the knob does not take.
SceneDescription load_scene(const std::string& name_or_path, const std::filesystem::path& assets_dir,
                            const KnobValues& knobs = {});

/// The folder that has `scenes/`: the environment variable PATHLIGHT_ASSETS if it is set, else `assets` in the
/// program's folder or one above it, else the source tree's own. Throws Error(Input) if there is none.
std::filesystem::path find_assets_dir();

/// Names of the scenes in assets_dir/scenes, sorted.
std::vector<std::string> list_scenes(const std::filesystem::path& assets_dir);

}  // namespace pl
