#include "ui/model/past_film.h"

#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "core/io/files.h"
#include "core/io/picture_file.h"
#include "ui/model/programs.h"

namespace pl::ui {

void PastFilm::begin() {
    if (time_.history()->frames.empty())
        return messages_.say(MessageLevel::Info, "there is no past yet: 'keep the past' takes key frames");
    folder_ = names_.next(options_.screenshot_dir, FileNames::stem_of(scene_) + "-past", {"", ".mp4"});
    written_ = 0;
    passes_ = 0;
    is_writing_ = true;
    time_.set_playing(false);
    show_next();
}

/// Key frames come and go meanwhile.
void PastFilm::show_next() {
    const auto& frames = time_.history()->frames;
    const auto next = std::ranges::find_if(frames, [&](const auto& frame) { return frame->passes() > passes_; });
    if (next == frames.end()) return finish();
    passes_ = (*next)->passes();
    time_.show(static_cast<std::size_t>(next - frames.begin()));
}

void PastFilm::update() {
    if (!is_writing_) return;
    if (time_.frame() == nullptr || time_.frame()->passes() != passes_) return stop();
    is_ready_ = flowers_.is_current();
}

void PastFilm::add(ByteImage pixels) {
    is_ready_ = false;
    jobs_.push([path = frame_file(folder_, written_, ImageKind::Png),
                shared = std::make_shared<const ByteImage>(std::move(pixels))]() -> Jobs::Report {
        make_folder(path.parent_path());
        save_window_pixels(path, *shared);
        return [] {};
    });
    ++written_;
    show_next();
}

void PastFilm::stop() {
    if (!is_writing_) return;
    is_writing_ = false;
    is_ready_ = false;
    messages_.say(MessageLevel::Warning, fmt::format("stopped: {} frames are in {}", written_, folder_.string()));
}

void PastFilm::finish() {
    is_writing_ = false;
    time_.show(std::nullopt);
    jobs_.push([this, folder = folder_]() -> Jobs::Report {
        return [this, text = make_film(folder, kFramesPerSecond)] { messages_.say(MessageLevel::Info, text); };
    });
}

}  // namespace pl::ui
