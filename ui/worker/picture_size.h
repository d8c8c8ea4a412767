// The size of the rendered film: that of the picture at rest, and coarser while the camera moves.
#pragma once

#include "core/session/session.h"
#include "ui/worker/motion_resolution.h"
#include "ui/worker/requests.h"

namespace pl::ui {

class PictureSize {
public:
    PictureSize(int width, int height) : width_(width), height_(height) {}

    int width() const { return width_; }
    int height() const { return height_; }
    /// Width and height of the session are divided by this; 0 after resize(), before apply().
    int divider() const { return divider_; }
    bool is_whole() const { return divider_ == 1; }

    /// Whether the picture is coarse: while the camera moves, and until a frame has shown its final position.
    bool is_coarse(const Requests& now) const { return now.low_resolution && (now.moving || is_unseen_); }
    void move_camera() { is_unseen_ = true; }
    void note_frame() { is_unseen_ = false; }

    /// Sets another size at rest; the next apply() gives it to the session.
    void resize(int width, int height);
    /// Gives the session the size for a picture that is coarse or not; true if its films were emptied.
    bool apply(Session& session, bool is_coarse);
    /// Observes the seconds of a pass, which decide how coarse the next motion begins.
    void observe(double seconds) { motion_.observe(divider_, seconds); }
    /// The cost of a pass is unknown again.
    void forget_cost() { motion_.reset(); }

private:
    int width_;
    int height_;
    int divider_ = 1;
    bool is_unseen_ = false;  ///< no frame shows the present camera yet
    MotionResolution motion_;
};

}  // namespace pl::ui
