// The part of ViewerModel that opens and saves. Files are read and written on the helper thread.
#include <chrono>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "ui/viewer_model.h"

namespace pl {
namespace {

/// For the numbers of a picture to come, before a failed worker is given up.
constexpr double kSaveSeconds = 3.0;
constexpr int kLastSaveMs = 3000;  ///< the same, when the window closes

}  // namespace

ViewerModel::~ViewerModel() {
    for (int waited = 0; !unsaved_.empty() && waited < kLastSaveMs; ++waited) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        take_frame();
    }
}

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
    const std::string stem = fmt::format("{}-{}", file_name_part(std::filesystem::path(scene_name_).stem().string()),
                                         info_of(frame_->settings.method).name);
    const std::filesystem::path name = names_.next(options_.screenshot_dir, stem, suffixes);
    for (const char* suffix : suffixes) unsaved_.push_back(name.string() + suffix);
    save_deadline_ = now_ + kSaveSeconds;
    worker_.set_values_wanted(true);
    write_unsaved();
}

/// Frames bring the numbers of a picture only when they are wanted: until one does, there is nothing to write.
void ViewerModel::write_unsaved() {
    if (!frame_->has_values()) {
        if (status_.state != WorkerState::Failed || now_ < save_deadline_) return;
        unsaved_.clear();
        say(LogLevel::Error, "the picture cannot be saved: rendering has failed");
        return;
    }
    ViewerPicture shown = picture();
    shown.settings = frame_->settings;
    shown.backend = frame_->backend.name;
    for (const std::filesystem::path& path : std::exchange(unsaved_, {})) {
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
