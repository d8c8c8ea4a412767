// The part of ViewerModel that opens and saves. Files are read and written on the helper thread.
#include <fmt/format.h>

#include "ui/viewer_model.h"

namespace pl {

void ViewerModel::reload() { start_loading(scene_name_, true); }

void ViewerModel::open(const std::string& scene) { start_loading(scene, false); }

void ViewerModel::start_loading(const std::string& name, bool keep_camera) {
    note(LogLevel::Info, "loading " + name);
    jobs_.push([this, name, keep_camera]() -> JobThread::Report {
        try {
            auto scene = options_.load_scene(name);
            return [this, scene, name, keep_camera] { adopt_scene(scene, name, keep_camera); };
        } catch (const std::exception& error) {
            return [this, text = std::string(error.what())] { say(LogLevel::Error, text); };
        }
    });
}

void ViewerModel::adopt_scene(std::shared_ptr<const SceneDescription> scene, const std::string& name,
                              bool keep_camera) {
    deselect();
    scene_name_ = name;
    const CameraDescription camera = keep_camera ? controls_.camera() : scene->camera;
    controls_ = CameraControls(scene->camera, bounds_of(*scene).diagonal());
    controls_.set_camera(camera);
    settings_.camera = camera;
    for (const std::string& warning : scene->warnings) say(LogLevel::Warning, warning);
    say(LogLevel::Info, fmt::format("opened {}: {} triangles", name, scene->triangles.size()));
    worker_.submit(EditScene{std::move(scene)});
    worker_.submit(EditCamera{camera});
}

void ViewerModel::save_screenshot() { save({".png"}); }

void ViewerModel::save_picture() { save({".exr", ".png"}); }

void ViewerModel::save(std::initializer_list<const char*> suffixes) {
    if (!frame_ || !options_.save_image) {
        say(LogLevel::Warning, "there is no picture to save yet");
        return;
    }
    ViewerPicture shown = picture();
    shown.settings = frame_->settings;
    shown.backend = frame_->backend.name;
    const std::string stem = fmt::format("{}-{}", file_name_part(std::filesystem::path(scene_name_).stem().string()),
                                         info_of(shown.settings.method).name);
    const std::filesystem::path name = names_.next(options_.screenshot_dir, stem, suffixes);
    for (const char* suffix : suffixes) {
        const std::filesystem::path path = name.string() + suffix;
        jobs_.push([this, path, shown, frame = frame_]() -> JobThread::Report {
            try {
                options_.save_image(path, frame->snapshot, shown);
                return [this, path] { say(LogLevel::Info, "saved " + path.string()); };
            } catch (const std::exception& error) {
                return [this, text = std::string(error.what())] { say(LogLevel::Error, text); };
            }
        });
    }
}

std::filesystem::path ViewerModel::next_window_shot() {
    const std::string stem = file_name_part(std::filesystem::path(scene_name_).stem().string()) + "-window";
    return names_.next(options_.screenshot_dir, stem, {".png"}).string() + ".png";
}

void ViewerModel::save_window(ScreenPixels pixels, std::filesystem::path path) {
    if (!options_.save_screen) {
        say(LogLevel::Warning, "this build cannot save the window");
        return;
    }
    jobs_.push([this, path, shared = std::make_shared<ScreenPixels>(std::move(pixels))]() -> JobThread::Report {
        try {
            options_.save_screen(path, *shared);
            return [this, path] { say(LogLevel::Info, "saved " + path.string()); };
        } catch (const std::exception& error) {
            return [this, text = std::string(error.what())] { say(LogLevel::Error, text); };
        }
    });
}

}  // namespace pl
