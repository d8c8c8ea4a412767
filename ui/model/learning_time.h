// The past of a learned field: key frames of it, and the one that the window shows in place of the present.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "ui/model/render_link.h"

namespace pl::ui {

class LearningTime {
public:
    static constexpr int kStandardMegabytes = 256;
    static constexpr double kFrameSeconds = 0.2;  ///< of a key frame while they are played

    explicit LearningTime(RenderLink& link) : link_(link), history_(link.worker().history()) {}

    /// Key frames are taken while they are kept. Otherwise none is, and they cost nothing.
    bool keeps() const { return keeps_; }
    void set_keeps(bool keeps);
    int megabytes() const { return megabytes_; }
    void set_megabytes(int megabytes);
    /// The newest key frame is needed for another display, whether the past is kept or not.
    void set_newest_needed(bool needed);

    /// Once per frame of the window, with its clock.
    void update(double seconds);

    /// Never null.
    const std::shared_ptr<const FieldHistory>& history() const { return history_; }
    /// Index of the key frame that is shown; empty: the present.
    std::optional<std::size_t> shown() const { return shown_; }
    void show(std::optional<std::size_t> frame);
    const FieldKeyFrame* frame() const { return shown_ ? history_->frames[*shown_].get() : nullptr; }
    /// The same, to be kept for longer than a frame of the window.
    std::shared_ptr<const FieldKeyFrame> shown_frame() const { return shown_ ? history_->frames[*shown_] : nullptr; }
    /// Plays key frames to the present and back.
    bool is_playing() const { return is_playing_; }
    void set_playing(bool playing);

    /// A volume at the shown time; null for the present, and before there was such a volume.
    std::shared_ptr<const VolumeInspection> inspection(std::int32_t volume);

private:
    void take_history();
    void play(double seconds);
    void send_limit();

    RenderLink& link_;
    std::shared_ptr<const FieldHistory> history_;
    bool keeps_ = false;
    bool newest_needed_ = false;
    int megabytes_ = kStandardMegabytes;
    std::optional<std::size_t> shown_;
    bool is_playing_ = false;
    int direction_ = 1;
    double stepped_ = 0.0;  ///< when the shown frame last changed, seconds
    std::map<std::int32_t, std::shared_ptr<const VolumeInspection>> inspections_;  ///< of the shown frame
};

}  // namespace pl::ui
