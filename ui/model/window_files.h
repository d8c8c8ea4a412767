// Files that the window writes and reads.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/session/learned_field.h"
#include "ui/viewer.h"

namespace pl::ui {

/// Writes .png (tone mapped) or .exr (linear) by suffix; `command` repeats the picture in a shell.
void save_window_picture(const std::filesystem::path& path, const Snapshot& snapshot, const ViewerPicture& picture,
                         const std::string& command);

/// Writes the pixels of the whole window, panels included, as .png.
void save_window_pixels(const std::filesystem::path& path, const ScreenPixels& pixels);

/// Reads a learned field for the open scene. Throws Error(Input) for a damaged file or one of another scene.
std::shared_ptr<LearnedField> load_window_field(const std::filesystem::path& path, const SceneDescription& scene);

}  // namespace pl::ui
