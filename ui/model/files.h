// The files that the viewer opens and saves, on the helper thread.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "ui/model/compare_controls.h"
#include "ui/model/display_controls.h"
#include "ui/model/file_names.h"
#include "ui/model/render_controls.h"
#include "ui/model/render_link.h"
#include "ui/model/viewed_scene.h"

namespace pl::ui {

/// Saving the picture and the window as image files, and the command line that renders the picture again.
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
    void save_window(ByteImage pixels, std::filesystem::path path);
    std::filesystem::path next_view_shot() { return names_.next(scene_, "view", {".png"}).string() + ".png"; }
    /// The same to the clipboard.
    void copy_view(ByteImage pixels);
    /// The curves of the accuracy panel, as SVG and as CSV.
    void save_plot(const std::string& svg, const std::string& csv);
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

// Saving the learned field, and continuing from a saved one.

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

class Files {
public:
    Files(const ModelServices& services, ViewedScene& scene, RenderControls& render, const DisplayControls& display,
          CompareControls& comparison)
        : messages_(services.messages), jobs_(services.jobs), scene_(scene), comparison_(comparison),
          names_(services.options.screenshot_dir), pictures_(services, names_, scene, render, display),
          fields_(services, names_, scene, render) {}

    PictureFiles& pictures() { return pictures_; }
    const PictureFiles& pictures() const { return pictures_; }
    SavedFields& fields() { return fields_; }

    /// A scene; a learned field of the scene in the window: a file that ends in kFieldSuffix; or a picture, which is compared with the one
    /// in the window.
    void open(const std::string& file);
    /// Opens the file whose path or URI is the text of the clipboard, else the picture there.
    void paste(const std::string& text);

    /// Begins to write the materials of the window, for --materials. Returns the name of the file.
    std::filesystem::path save_materials();

private:
    void open_picture(const std::filesystem::path& path);
    void compare_with(const OpenedPicture& picture);

    Messages& messages_;
    Jobs& jobs_;
    ViewedScene& scene_;
    CompareControls& comparison_;
    FileNames names_;
    PictureFiles pictures_;
    SavedFields fields_;
};

}  // namespace pl::ui
