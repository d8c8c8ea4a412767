// Names of the files that the viewer saves: scene, kind and a number that is not taken, "cornell-default-0001".
#pragma once

#include <filesystem>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>

#include "core/session/learned_field.h"
#include "ui/model/viewed_scene.h"
#include "ui/viewer.h"

namespace pl::ui {

/// Numbered file names that never overwrite an existing file.
class NumberedNames {
public:
    /// "DIR/STEM-0001" without suffix. No file of this name with one of the suffixes exists, and it was not returned before.
    std::filesystem::path next(const std::filesystem::path& dir, const std::string& stem,
                               std::initializer_list<const char*> suffixes);

private:
    int last_ = 0;  ///< covers returned names whose files are not written yet
};

/// Letters, digits, '-' and '_' of the text, the rest replaced by '-'.
std::string file_name_part(const std::string& text);

class FileNames {
public:
    explicit FileNames(std::filesystem::path folder) : folder_(std::move(folder)) {}

    const std::filesystem::path& folder() const { return folder_; }
    /// The beginning of the names of a scene's files.
    static std::string stem_of(const ViewedScene& scene) {
        return file_name_part(std::filesystem::path(scene.name()).stem().string());
    }
    /// Without suffix; no file of this name and one of the suffixes exists.
    std::filesystem::path next(const ViewedScene& scene, std::string_view kind,
                               std::initializer_list<const char*> suffixes) {
        return numbers_.next(folder_, stem_of(scene) + "-" + std::string(kind), suffixes);
    }

private:
    std::filesystem::path folder_;
    NumberedNames numbers_;
};

// Files that the window writes and reads.

/// Writes .png (tone mapped) or .exr (linear) by suffix; `command` repeats the picture in a shell.
void save_window_picture(const std::filesystem::path& path, const Snapshot& snapshot, const ViewerPicture& picture,
                         const std::string& command);

/// Writes the pixels of the whole window, panels included, as .png.
void save_window_pixels(const std::filesystem::path& path, const ByteImage& pixels);

/// Reads a learned field for the open scene. Throws Error(Input) for a damaged file or one of another scene.
std::shared_ptr<LearnedField> load_window_field(const std::filesystem::path& path, const SceneDescription& scene);

}  // namespace pl::ui
