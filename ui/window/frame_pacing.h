// When the window draws a frame and how long it sleeps in between: 60 frames per second under input, a few while only
// counters change, one per second while nothing does. Times are seconds of one steady clock.
#pragma once

#include <cstdint>

namespace pl::ui {

/// Reasons for the window to stay awake.
struct WindowActivity {
    bool is_scripted = false;
    bool has_input = false;   ///< keys or buttons are held
    bool is_working = false;  ///< the camera moves, or background work runs
    bool is_at_rest = false;  ///< rendering is paused or done, and no message is shown
    bool has_toasts = false;
};

class FramePacing {
public:
    static constexpr double kFrameSeconds = 1.0 / 60.0;
    static constexpr double kIdleWaitSeconds = 0.25;  ///< sleep while nothing changes
    static constexpr double kStatusSeconds = 0.1;     ///< between frames without a new picture: counters change
    static constexpr double kSettleSeconds = 0.6;     ///< after an event: panels come to rest, tooltips appear
    static constexpr double kIdleSeconds = 1.0;       ///< between frames of an idle window

    explicit FramePacing(double now) : last_start_(now) {}

    void note_event(double now) { settle_until_ = now + kSettleSeconds; }
    void set_hidden(bool hidden) { hidden_ = hidden; }

    /// How long the window sleeps before its next frame unless an event wakes it; not positive if the frame is due.
    double sleep_seconds(double now, const WindowActivity& activity);
    /// A frame begins. Returns the time since the beginning of the previous one.
    double begin(double now);
    /// Whether the frame is drawn; `serial` is the number of the newest picture.
    bool needs_redraw(double now, std::uint64_t serial, const WindowActivity& activity);
    /// The frame was presented. Returns the time since the previous one, -1 after a rest.
    double end(double now);

private:
    double last_start_;
    double last_shown_ = -1.0;
    double settle_until_ = 0.0;  ///< until then every frame is drawn
    std::uint64_t shown_serial_ = 0;
    bool idle_ = false;
    bool rested_ = true;  ///< slept since the previous frame
    bool hidden_ = false;
};

}  // namespace pl::ui
