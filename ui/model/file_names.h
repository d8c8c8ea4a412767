// Names of the files that the viewer saves: scene, kind and a number that is not taken, "cornell-default-0001".
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

#include "ui/model/numbered_names.h"
#include "ui/model/viewed_scene.h"

namespace pl::ui {

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

}  // namespace pl::ui
