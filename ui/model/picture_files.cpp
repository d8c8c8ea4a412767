#include "ui/model/picture_files.h"

#include <chrono>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "ui/model/window_files.h"

namespace pl::ui {
namespace {

constexpr double kSaveSeconds = 3.0;  ///< longest wait for the values of a picture from a failed render thread
constexpr int kLastSaveMs = 3000;     ///< the same when the window closes

}  // namespace

PictureFiles::PictureFiles(const ModelServices& services, FileNames& names, const ViewedScene& scene,
                           const RenderControls& render, const DisplayControls& display)
    : options_(services.options), messages_(services.messages), jobs_(services.jobs), link_(services.link),
      names_(names), scene_(scene), render_(render), display_(display) {}

void PictureFiles::update() {
    if (!unsaved_.empty()) write_unsaved();
}

void PictureFiles::finish() {
    for (int waited = 0; !unsaved_.empty() && waited < kLastSaveMs; ++waited) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        link_.take_frame();
        update();
    }
}

ViewerPicture PictureFiles::picture() const {
    return {.scene = scene_.shown(),
            .description = scene_.materials().file(),
            .backend = link_.status().backend,
            .settings = render_.settings(),
            .display = display_.settings(),
            .limits = render_.limits(),
            .spp = link_.status().passes,
            .edited_materials = scene_.materials().edited_names()};
}

std::string PictureFiles::command_line(const std::string& field, const std::string& materials) const {
    if (!options_.command_line) return "";
    ViewerPicture shown = picture();
    shown.field = field;
    shown.materials = materials;
    return options_.command_line(shown);
}

void PictureFiles::save(std::initializer_list<const char*> suffixes) {
    if (!link_.frame()) {
        messages_.say(MessageLevel::Warning, "there is no picture to save yet");
        return;
    }
    const std::filesystem::path name = names_.next(scene_, info_of(link_.frame()->settings.method).name, suffixes);
    for (const char* suffix : suffixes) save_as(name.string() + suffix);
}

void PictureFiles::save_as(const std::filesystem::path& path) {
    unsaved_.push_back(path);
    deadline_ = messages_.now() + kSaveSeconds;
    link_.worker().set_values_wanted(true);
    write_unsaved();
}

/// Frames carry pixel values only on request: until one has arrived, there is nothing to write.
void PictureFiles::write_unsaved() {
    const auto& frame = link_.frame();
    if (!frame->has_values()) {
        if (link_.status().state != WorkerState::Failed || messages_.now() < deadline_) return;
        unsaved_.clear();
        messages_.say(MessageLevel::Error, "the picture cannot be saved: rendering has failed");
        return;
    }
    ViewerPicture shown = picture();
    shown.settings = frame->settings;
    shown.backend = frame->backend.name;
    shown.spp = frame->snapshot.passes;
    for (const std::filesystem::path& path : std::exchange(unsaved_, {})) {
        jobs_.push([this, path, shown, frame]() -> JobThread::Report {
            save_window_picture(path, frame->snapshot, shown,
                                options_.command_line ? options_.command_line(shown) : "");
            return [this, path] { messages_.say(MessageLevel::Info, "saved " + path.string()); };
        });
    }
}

void PictureFiles::save_window(ScreenPixels pixels, std::filesystem::path path) {
    jobs_.push([this, path, shared = std::make_shared<ScreenPixels>(std::move(pixels))]() -> JobThread::Report {
        save_window_pixels(path, *shared);
        return [this, path] { messages_.say(MessageLevel::Info, "saved " + path.string()); };
    });
}

}  // namespace pl::ui
