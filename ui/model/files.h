// The files that the viewer opens and saves, on the helper thread.
#pragma once

#include <string>

#include "ui/model/picture_files.h"
#include "ui/model/saved_fields.h"

namespace pl::ui {

class Files {
public:
    Files(const ModelServices& services, ViewedScene& scene, RenderControls& render, const DisplayControls& display)
        : messages_(services.messages), jobs_(services.jobs), scene_(scene), names_(services.options.screenshot_dir),
          pictures_(services, names_, scene, render, display), fields_(services, names_, scene, render) {}

    PictureFiles& pictures() { return pictures_; }
    const PictureFiles& pictures() const { return pictures_; }
    SavedFields& fields() { return fields_; }

    /// A scene, or a learned field of the scene in the window: a file that ends in kFieldSuffix.
    void open(const std::string& file) {
        if (std::filesystem::path(file).extension() == kFieldSuffix)
            fields_.load(file);
        else
            scene_.open(file);
    }

    /// Begins to write the materials of the window, for --materials. Returns the name of the file.
    std::filesystem::path save_materials();

private:
    Messages& messages_;
    Jobs& jobs_;
    ViewedScene& scene_;
    FileNames names_;
    PictureFiles pictures_;
    SavedFields fields_;
};

}  // namespace pl::ui
