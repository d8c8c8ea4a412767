// The schedule of new frames for the window: at a rate that falls with the age of the picture, and at once if the
// newest frame lacks data that is available.
#pragma once

#include "core/base/timer.h"
#include "ui/worker/requests.h"

namespace pl::ui {

/// Seconds between two frames: the longer a picture has rendered, the less a pass changes it.
constexpr double frame_interval(double rendered_seconds) {
    return rendered_seconds < 2.0 ? 1.0 / 30.0 : (rendered_seconds < 10.0 ? 0.1 : 0.25);
}

class FrameSchedule {
public:
    /// The newest frame lacks data: the next one is due at once.
    void ask() { is_asked_ = true; }
    bool is_asked() const { return is_asked_; }
    /// Whether the window requests another display of the same film.
    bool is_stale(const Requests& now) const {
        return now.display != display_ || (now.values && !has_values_) || (now.denoised && !is_denoised_);
    }
    /// Whether a frame of `passes` is due now. `rendered_seconds` is the age of the picture.
    bool is_due(std::uint32_t passes, bool is_moving, double rendered_seconds) const;
    bool shows(std::uint32_t passes) const { return passes == passes_; }

    /// Before a frame or its parts are made: a failure is reported once and not tried again.
    void settle(const Requests& now);
    /// The frame is being made.
    void begin() { is_asked_ = false; }
    /// The frame is out.
    void end(std::uint32_t passes);
    /// Another film follows, of which no frame was made.
    void change_film() { passes_ = 0; }

private:
    bool is_asked_ = false;
    DisplaySettings display_;
    bool has_values_ = false;
    bool is_denoised_ = false;
    std::uint32_t passes_ = 0;
    std::optional<Stopwatch> age_;
};

}  // namespace pl::ui
