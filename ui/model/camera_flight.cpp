#include "ui/model/camera_flight.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/camera_file.h"
#include "core/io/picture_file.h"
#include "ui/model/numbered_names.h"

namespace pl::ui {
namespace {

constexpr const char* kTooFew = "a path needs at least two bookmarks: F8 makes one of the camera";

}  // namespace

void CameraFlight::toggle() {
    if (is_flying()) return stop();
    path_ = bookmarks_.path();
    start_.reset();
    if (!path_) messages_.say(MessageLevel::Info, kTooFew);
}

void CameraFlight::update(double seconds) {
    if (!path_) return;
    if (start_ && camera_.generation() != generation_) return stop();
    if (!start_) start_ = seconds;
    const double at = (seconds - *start_) / std::max(static_cast<double>(seconds_per_camera_), 0.01);
    camera_.set(path_->at(at));
    generation_ = camera_.generation();
    if (at >= static_cast<double>(path_->size() - 1)) stop();
}

void SequenceWriter::begin() {
    auto path = bookmarks_.path();
    if (!path) return messages_.say(MessageLevel::Info, kTooFew);
    if (wanted_.spp == 0 && !(wanted_.seconds > 0.0f))
        return messages_.say(MessageLevel::Info, "a frame needs a limit: samples or seconds above 0");
    const std::string stem = std::filesystem::path(pictures_.picture().scene.name).stem().string();
    folder_ = names_.next(viewer_.screenshot_dir, file_name_part(stem) + "-sequence", {""});
    try {
        make_folder(folder_);
        save_cameras(path_file(), bookmarks_.cameras());
    } catch (const Error& error) {
        return messages_.say(MessageLevel::Error, error.what());
    }
    path_ = std::move(path);
    now_ = wanted_;
    limits_before_ = render_.limits();
    render_.set_limits(limits_of_frame());
    written_ = 0;
    show_frame();
}

void SequenceWriter::show_frame() {
    is_saving_ = false;
    camera_.set(path_->frame(written_, now_.frames));
    generation_ = camera_.generation();
}

std::filesystem::path SequenceWriter::file() const { return frame_file(folder_, written_, now_.kind); }

std::filesystem::path SequenceWriter::path_file() const { return folder_ / "cameras.json"; }

SampleLimits SequenceWriter::limits_of_frame() const {
    return {.spp = static_cast<std::uint32_t>(now_.spp), .seconds = static_cast<double>(now_.seconds)};
}

/// The whole picture of the camera, with all of its samples.
bool SequenceWriter::is_frame_done() const {
    const auto& frame = link_.frame();
    const WorkerStatus& status = link_.status();
    return status.state == WorkerState::Done && status.generation >= generation_ && !camera_.is_moving() && frame &&
           frame->generation >= generation_ && frame->divider == 1 && frame->preview == Preview::None &&
           frame->snapshot.passes == status.passes;
}

void SequenceWriter::update() {
    if (!path_) return;
    if (camera_.generation() != generation_) return stop();
    if (!is_saving_) {
        if (!is_frame_done()) return;
        pictures_.save_as(file());
        is_saving_ = true;
    }
    if (pictures_.is_waiting()) return;
    if (++written_ < now_.frames)
        show_frame();
    else
        finish();
}

void SequenceWriter::stop() {
    if (!path_) return;
    path_.reset();
    render_.set_limits(limits_before_);
    messages_.say(MessageLevel::Warning, fmt::format("stopped: {} of {} frames are in {}, the one under way is lost",
                                                     written_, now_.frames, folder_.string()));
}

std::string SequenceWriter::command() const {
    if (!viewer_.command_line) return "";
    ViewerPicture picture = pictures_.picture();
    picture.sequence = {.folder = folder_,
                        .cameras = path_file(),
                        .frames = now_.frames,
                        .kind = now_.kind,
                        .limits = limits_of_frame()};
    return viewer_.command_line(picture);
}

void SequenceWriter::finish() {
    const std::string same = command();
    path_.reset();
    render_.set_limits(limits_before_);
    messages_.say(MessageLevel::Info, fmt::format("{} frames are in {}", written_, folder_.string()));
    if (!same.empty()) messages_.note(MessageLevel::Info, "the same path without a window: " + same);
}

std::optional<SequenceWriter::Written> SequenceWriter::progress() const {
    return path_ ? std::optional(Written{written_, now_.frames}) : std::nullopt;
}

}  // namespace pl::ui
