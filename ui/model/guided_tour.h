// The guided tour: six steps in the scene `door`, each done by the user's own click or key. It changes settings only where it
// begins, and can be left and continued at any time.
#pragma once

#include <span>
#include <string>

#include "ui/model/viewed_scene.h"

namespace pl::ui {

class ViewerModel;

struct TourStep {
    const char* title;
    const char* text;   ///< the meaning of the highlighted part
    const char* task;   ///< the click or key that completes the step
    const char* place;  ///< label of the control to be highlighted, see note_place(); kPicture for the picture

    static constexpr const char* kPicture = "picture";
};
std::span<const TourStep> tour_steps();

class GuidedTour {
public:
    static constexpr const char* kScene = "door";
    /// A step is complete when its task has been done for this time: a drag goes on for a while.
    static constexpr double kRestSeconds = 1.0;

    enum class Phase {
        Off,
        Offered,
        Opening,  ///< the scene is being loaded
        Running,
        Finished,  ///< the last word is shown
    };

    Phase phase() const { return phase_; }
    /// From 0; where it continues while it is off.
    int step() const { return step_; }
    /// Whether the offer was answered in any way, so that it is not made again.
    bool is_answered() const { return is_answered_; }

    /// As in another session.
    void remember(int step, bool is_answered);
    /// Offers it, unless that was answered before.
    void offer();
    /// Begins, or continues where it was left: opens the scene if it is another one, and lets the method that learns and the
    /// baseline render in turns of equal time, without light samples, split.
    void begin(ViewerModel& model);
    void skip_step(ViewerModel& model);
    void leave();

    /// Once per frame of the window, with its clock.
    void update(ViewerModel& model, double seconds);

private:
    /// The state that the tasks change, as it was at the beginning of the step.
    struct Before {
        float split = 0.0f;
        KnobValues knobs{};
        CameraDescription camera{};
        bool next_event = false;
    };

    void prepare(ViewerModel& model);
    void start_step(const ViewerModel& model);
    bool is_done(const ViewerModel& model) const;

    Phase phase_ = Phase::Off;
    int step_ = 0;
    bool is_answered_ = false;
    Before before_;
    double done_since_ = -1.0;  ///< negative: not done
};

/// "off", "offered", "opening", "1" to "6", "finished".
std::string state_text(const GuidedTour& tour);

}  // namespace pl::ui
