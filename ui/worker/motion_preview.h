// The preview that takes the place of a noisy picture while the camera moves: few samples of the baseline without light samples
// show a field of dots. Its films are its own or are emptied with it: no sample of a preview ever comes to the picture.
#pragma once

#include "core/session/session.h"
#include "ui/worker/published_frame.h"

namespace pl::ui {

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
