#include "ui/model/learning_time.h"

#include <algorithm>

namespace pl::ui {

void LearningTime::send_limit() {
    const std::size_t kept = keeps_ ? static_cast<std::size_t>(megabytes_) << 20 : 0;
    link_.worker().set_history_limit(kept > 0 || !newest_needed_ ? kept : 1);
}

void LearningTime::set_keeps(bool keeps) {
    if (keeps == keeps_) return;
    keeps_ = keeps;
    if (!keeps) {
        show(std::nullopt);
        is_playing_ = false;
    }
    send_limit();
}

void LearningTime::set_megabytes(int megabytes) {
    if (megabytes == megabytes_) return;
    megabytes_ = std::max(megabytes, 1);
    send_limit();
}

void LearningTime::set_newest_needed(bool needed) {
    if (needed == newest_needed_) return;
    newest_needed_ = needed;
    send_limit();
}

/// The shown frame stays the same one while others come and go.
void LearningTime::take_history() {
    const std::shared_ptr<const FieldHistory> history = link_.worker().history();
    if (history == history_) return;
    const FieldKeyFrame* const now = frame();
    history_ = history;
    if (now == nullptr) return;
    const auto same = std::ranges::find(history_->frames, now, [](const auto& kept) { return kept.get(); });
    if (same != history_->frames.end())
        shown_ = static_cast<std::size_t>(same - history_->frames.begin());
    else
        show(std::nullopt);
}

void LearningTime::show(std::optional<std::size_t> frame) {
    if (frame && *frame >= history_->frames.size()) frame.reset();
    if (frame == shown_) return;
    shown_ = frame;
    inspections_.clear();
}

void LearningTime::set_playing(bool playing) {
    is_playing_ = playing;
    direction_ = shown_ ? 1 : -1;
}

/// Positions 0 to n - 1 are key frames, n is the present.
void LearningTime::play(double seconds) {
    const auto last = static_cast<int>(history_->frames.size());
    if (!is_playing_ || last == 0 || seconds - stepped_ < kFrameSeconds) return;
    stepped_ = seconds;
    const int at = shown_ ? static_cast<int>(*shown_) : last;
    if (at + direction_ < 0 || at + direction_ > last) direction_ = -direction_;
    const int next = std::clamp(at + direction_, 0, last);
    show(next < last ? std::optional(static_cast<std::size_t>(next)) : std::nullopt);
}

void LearningTime::update(double seconds) {
    take_history();
    play(seconds);
}

std::shared_ptr<const VolumeInspection> LearningTime::inspection(std::int32_t volume) {
    if (frame() == nullptr || volume < 0 || static_cast<std::size_t>(volume) >= frame()->volumes()) return nullptr;
    auto& inspection = inspections_[volume];
    if (inspection == nullptr) inspection = std::make_shared<const VolumeInspection>(frame()->inspect(volume));
    return inspection;
}

}  // namespace pl::ui
