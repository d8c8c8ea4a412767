// Saving the learned field, and continuing from a saved one.
#pragma once

#include <filesystem>
#include <string_view>

#include "ui/model/file_names.h"
#include "ui/model/render_controls.h"
#include "ui/model/services.h"
#include "ui/model/viewed_scene.h"

namespace pl::ui {

/// Suffix of learned fields that the viewer saves.
inline constexpr std::string_view kFieldSuffix = ".field";

class SavedFields {
public:
    SavedFields(const ModelServices& services, FileNames& names, const ViewedScene& scene, RenderControls& render);

    /// Takes a field from the render thread to write; once per frame of the window.
    void update();

    /// Writes the field as the render thread has it next. Without a field a message says so.
    void save();
    /// The same, and returns the name of its file beforehand.
    std::filesystem::path save_as_named();
    void load(const std::filesystem::path& path);
    /// The newest saved field of the scene in the window.
    void load_newest();

private:
    void adopt(const std::shared_ptr<LearnedField>& field, const std::filesystem::path& path);
    std::filesystem::path next_name(MethodId method);
    std::filesystem::path newest_file() const;

    Messages& messages_;
    Jobs& jobs_;
    RenderLink& link_;
    FileNames& names_;
    const ViewedScene& scene_;
    RenderControls& render_;
    std::filesystem::path promised_;  ///< the name for the field that was requested; empty if any will do
};

}  // namespace pl::ui
