// The guided tour: six steps in the scene `door`, each done by the user's own click or key, and followed by what was seen. It changes
// settings only where it begins, and can be left and continued at any time.
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
    const char* seen;   ///< what it has shown; empty if that is measured, see seen_text()
    const char* place;  ///< label of the control to be highlighted, see note_place(); kPicture for the picture

    static constexpr const char* kPicture = "picture";
};
std::span<const TourStep> tour_steps();

class GuidedTour {
public:
    static constexpr const char* kScene = "door";
    /// A task is done when it has been done for this time: a drag goes on for a while.
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
    /// One step on, also before its task is done; after the last one the last page.
    void next_step(ViewerModel& model);
    void last_step(ViewerModel& model);
    /// The task of the step has been done.
    bool is_seen() const { return is_seen_; }
    void leave();

    /// Once per frame of the window, with its clock.
    void update(ViewerModel& model, double seconds);

private:
    /// The state that the tasks change, as it was at the beginning of the step.
    struct Before {
        float split = 0.0f;
        KnobValues knobs{};
        CameraDescription camera{};
    };

    void prepare(ViewerModel& model);
    void change_step(ViewerModel& model, int step);
    void start_step(const ViewerModel& model);
    bool is_done(const ViewerModel& model) const;

    Phase phase_ = Phase::Off;
    int step_ = 0;
    bool is_answered_ = false;
    Before before_;
    KnobValues knobs_{};        ///< at which the field began last
    double done_since_ = -1.0;  ///< negative: not done
    bool is_seen_ = false;
    bool forgets_ = false;  ///< as soon as the picture has its full size: coarse passes train the field on no clock
};

/// What a step has shown, once its task is done: measured where that can be.
std::string seen_text(const ViewerModel& model, int step);
/// The factors of learning in the scene of the tour as measured, without and with light samples.
std::string lesson_text(const ViewerModel& model);

/// "off", "offered", "opening", "1" to "6", "finished".
std::string state_text(const GuidedTour& tour);

}  // namespace pl::ui
