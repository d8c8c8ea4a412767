#include "ui/window/frame_pacing.h"

#include <utility>

namespace pl::ui {

double FramePacing::sleep_seconds(double now, const WindowActivity& activity) {
    idle_ = !activity.is_scripted && now > settle_until_ && !activity.has_input && !activity.is_working &&
            (activity.is_at_rest || hidden_);
    if (!idle_) return last_start_ + kFrameSeconds - now;
    rested_ = true;
    return kIdleWaitSeconds;
}

double FramePacing::begin(double now) { return now - std::exchange(last_start_, now); }

bool FramePacing::needs_redraw(double now, std::uint64_t serial, const WindowActivity& activity) {
    if (hidden_) return false;
    const bool is_new_picture = std::exchange(shown_serial_, serial) != serial;
    const double longest = idle_ ? kIdleSeconds : kStatusSeconds;
    return activity.is_scripted || is_new_picture || now < settle_until_ || activity.has_input ||
           activity.has_toasts || now - last_shown_ >= longest;
}

double FramePacing::end(double now) {
    const double interval = rested_ ? -1.0 : now - last_shown_;
    last_shown_ = now;
    rested_ = false;
    return interval;
}

}  // namespace pl::ui
