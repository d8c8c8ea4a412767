// Saving the picture and the window as image files, and the command line that renders the picture again.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include "ui/model/display_controls.h"
#include "ui/model/file_names.h"
#include "ui/model/render_controls.h"
#include "ui/model/services.h"
#include "ui/model/viewed_scene.h"

namespace pl::ui {

class PictureFiles {
public:
    PictureFiles(const ModelServices& services, FileNames& names, const ViewedScene& scene,
                 const RenderControls& render, const DisplayControls& display);

    /// Once per frame of the window: writes pictures whose values have arrived.
    void update();
    /// Waits up to three seconds for the values of pictures that are still to be written.
    void finish();
    /// Pictures are waiting for a frame with values.
    bool is_waiting() const { return !unsaved_.empty(); }

    void save_png() { save({".png"}); }
    void save_exr_and_png() { save({".exr", ".png"}); }
    /// The picture that is shown now, to a file whose suffix decides its kind.
    void save_as(const std::filesystem::path& path);
    /// Pixels of the window, which only the window can read.
    void save_window(ScreenPixels pixels, std::filesystem::path path);
    std::filesystem::path next_window_shot() { return names_.next(scene_, "window", {".png"}).string() + ".png"; }

    /// The picture in the window with its settings.
    ViewerPicture picture() const;
    /// Continues from a file with a learned field, and takes the materials from another file, if they are not empty. Empty in
    /// builds without it.
    std::string command_line(const std::string& field = "", const std::string& materials = "") const;

private:
    void save(std::initializer_list<const char*> suffixes);
    void write_unsaved();

    const ViewerOptions& options_;
    Messages& messages_;
    Jobs& jobs_;
    RenderLink& link_;
    FileNames& names_;
    const ViewedScene& scene_;
    const RenderControls& render_;
    const DisplayControls& display_;
    std::vector<std::filesystem::path> unsaved_;  ///< waiting for a frame with values
    double deadline_ = 0.0;                       ///< end of the wait if rendering has failed
};

}  // namespace pl::ui
