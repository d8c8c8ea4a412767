// The size of the rendered film: that of the picture at rest, and coarser while the camera moves.
#pragma once

#include "core/session/session.h"
#include "ui/worker/published_frame.h"
#include "ui/worker/requests.h"

namespace pl::ui {

// The divider of the picture's size while the camera moves, which keeps up the frame rate.

/// Divider of width and height, one of 1, 2, 4, 8. Aims at a pass time. Changes outside a dead band only, so that the size does
/// not flicker.
class MotionResolution {
public:
    static constexpr double kTargetSeconds = 1.0 / 30.0;
    static constexpr double kDeadBand = 0.2;
    static constexpr int kMaxDivider = 8;
    static constexpr int kMinLongSide = 128;

    int divider() const { return divider_; }

    /// A pass took this long at this divider. Passes at rest (divider 1) set the divider that the next motion begins with.
    void observe(int divider, double seconds);

    /// The cost of a pass is unknown again.
    void reset() { divider_ = 4; }

    /// The divider, or a smaller one for images whose long side would fall below kMinLongSide.
    int divider_for(int width, int height) const;

private:
    int divider_ = 4;
};

/// Width or height after division; at least 1.
constexpr int divided(int size, int divider) { return size / divider > 0 ? size / divider : 1; }

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
    /// Gives a session, and one beside it if there is one, the size for a picture that is coarse or not; true if films were emptied.
    bool apply(Session& session, bool is_coarse, Session* second = nullptr);
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

/// The preview that takes the place of a noisy picture while the camera moves: few samples of the baseline without light samples
/// show a field of dots. Its films are its own or are emptied with it: no sample of a preview ever comes to the picture.
class MotionPreview {
public:
    /// After the motion the last preview stays until the picture has this many passes or seconds of work.
    static constexpr std::uint32_t kEnoughPasses = 16;
    static constexpr double kEnoughSeconds = 2.0;

    /// The best one for a film in motion. None for films that guide, sample lights or trace no paths. The learned radiance
    /// map if a method has learned; light samples only if none has, because switching them empties all fields.
    static Preview choose(const Session& session, FilmSlot film, Preview now);

    Preview now() const { return now_; }
    /// Gives the session the estimator of the preview, or its own back; true if its films were emptied. Nothing without a
    /// change.
    bool apply(Session& session, Preview wanted);
    /// The film that is rendered in place of `film`.
    FilmSlot slot(const Session& session, FilmSlot film) const;

    /// A frame is out; of the preview, or of the picture.
    void note_frame() { is_on_screen_ = now_ != Preview::None; }
    /// The user asked for something else than motion, whose first frame is not held back.
    void release() { is_on_screen_ = false; }
    /// Whether a frame of the picture is too early: the window still shows a preview, which is better.
    bool holds_back(std::uint32_t passes, double seconds) const {
        return is_on_screen_ && now_ == Preview::None && passes < kEnoughPasses && seconds < kEnoughSeconds;
    }

private:
    Preview now_ = Preview::None;
    EditEstimator own_{};  ///< of the session while light samples are switched on for a preview
    bool is_on_screen_ = false;
};

}  // namespace pl::ui
