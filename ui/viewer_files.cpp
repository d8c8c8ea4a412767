// The part of ViewerModel that opens and saves. Files are read and written on the helper thread.
#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "core/io/field_file.h"
#include "ui/viewer_model.h"
#include "ui/window_files.h"

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

/// Runs a job on the helper thread; what it throws is told.
void ViewerModel::push_job(std::function<JobThread::Report()> job) {
    jobs_.push([this, job = std::move(job)]() -> JobThread::Report {
        try {
            return job();
        } catch (const std::exception& error) {
            return [this, text = std::string(error.what())] { say(LogLevel::Error, text); };
        }
    });
}

/// What the names of saved files begin with.
std::string ViewerModel::file_stem() const {
    return file_name_part(std::filesystem::path(scene_name_).stem().string());
}

void ViewerModel::reload() { start_loading(scene_name_, true); }

void ViewerModel::open(const std::string& file) {
    if (std::filesystem::path(file).extension() == kFieldSuffix)
        load_field(file);
    else
        start_loading(file, false);
}

void ViewerModel::start_loading(const std::string& name, bool keep_camera) {
    note(LogLevel::Info, "loading " + name);
    push_job([this, name, keep_camera]() -> JobThread::Report {
        auto scene = options_.load_scene(name);
        return [this, scene, name, keep_camera] { adopt_scene(scene, name, keep_camera); };
    });
}

void ViewerModel::adopt_scene(std::shared_ptr<const SceneDescription> scene, const std::string& name,
                              bool keep_camera) {
    deselect();
    selected_material_.reset();
    materials_.open(scene);
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
    if (!frame_) {
        say(LogLevel::Warning, "there is no picture to save yet");
        return;
    }
    const std::string stem = fmt::format("{}-{}", file_stem(), info_of(frame_->settings.method).name);
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
        push_job([this, path, shown, frame = frame_]() -> JobThread::Report {
            save_window_picture(path, frame->snapshot, shown,
                                options_.command_line ? options_.command_line(shown) : "");
            return [this, path] { say(LogLevel::Info, "saved " + path.string()); };
        });
    }
}

std::filesystem::path ViewerModel::next_window_shot() {
    const std::string stem = file_stem() + "-window";
    return names_.next(options_.screenshot_dir, stem, {".png"}).string() + ".png";
}

void ViewerModel::save_window(ScreenPixels pixels, std::filesystem::path path) {
    push_job([this, path, shared = std::make_shared<ScreenPixels>(std::move(pixels))]() -> JobThread::Report {
        save_window_pixels(path, *shared);
        return [this, path] { say(LogLevel::Info, "saved " + path.string()); };
    });
}

void ViewerModel::save_field() { worker_.request_learned(); }

void ViewerModel::take_learned() {
    const std::optional<LearnedAnswer> answer = worker_.take_learned();
    if (!answer) return;
    if (!answer->field) {
        say(LogLevel::Warning, answer->reason);
        return;
    }
    const std::string suffix(kFieldSuffix);
    const std::string stem = fmt::format("{}-{}", file_stem(), info_of(answer->field->method).name);
    const std::filesystem::path path = names_.next(options_.screenshot_dir, stem, {suffix.c_str()}).string() + suffix;
    push_job([this, path, field = answer->field]() -> JobThread::Report {
        write_field(path, *field);
        return [this, text = fmt::format("saved {}: {}", path.string(), summary_of(*field))] {
            say(LogLevel::Info, text);
        };
    });
}

void ViewerModel::load_last_field() {
    std::filesystem::path newest;
    std::filesystem::file_time_type newest_time{};
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(options_.screenshot_dir, error)) {
        const std::filesystem::path& path = entry.path();
        if (path.extension() != kFieldSuffix || !path.filename().string().starts_with(file_stem() + "-")) continue;
        const auto time = entry.last_write_time(error);
        if (error || (!newest.empty() && time < newest_time)) continue;
        newest = path;
        newest_time = time;
    }
    if (newest.empty()) {
        say(LogLevel::Warning,
            fmt::format("nothing learned in {} was saved in {}", scene_name_, options_.screenshot_dir.string()));
        return;
    }
    load_field(newest);
}

void ViewerModel::load_field(const std::filesystem::path& path) {
    push_job([this, path, scene = open_scene()]() -> JobThread::Report {
        const std::shared_ptr<LearnedField> field =
            load_window_field(path, *scene.description, options_.settings.field);
        return [this, field, path, scene] {
            if (scene.description != status_.scene)
                say(LogLevel::Error, fmt::format("{}: the scene was changed meanwhile", path.string()));
            else
                adopt_field(field, path);
        };
    });
}

void ViewerModel::adopt_field(const std::shared_ptr<LearnedField>& field, const std::filesystem::path& path) {
    deselect();
    set_turns(false);
    field->settings.lookup = settings_.field.lookup;
    field->shape.lookup = settings_.field.lookup;
    if (field->method != settings_.method) previous_method_ = settings_.method;
    settings_.method = field->method;
    settings_.field = field->settings;
    worker_.submit(EditLearned{field});
    say(LogLevel::Info, fmt::format("going on from {}: {}", path.string(), summary_of(*field)));
}

}  // namespace pl
