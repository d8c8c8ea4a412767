#include "ui/model/guided_tour.h"

#include <array>

#include <fmt/format.h>

#include "ui/model/viewer_model.h"

namespace pl::ui {
namespace {

enum Step { kSplit, kPick, kDisc, kKnob, kFly, kPays, kStepCount };

constexpr std::array<TourStep, kStepCount> kSteps{{
    {"One scene, two methods, the same time",
     "Light enters this room through the gap of a door. Both halves of the picture get the same time: the left one "
     "by "
     "Reinforcement, which learns while it renders, the right one by Default, which does not.",
     "Drag the line between the halves.", "", "split line"},
    {"Where light comes from",
     "The surfaces are divided among radiance volumes. Each one learns from which directions light arrives.",
     "Click the floor or a wall in the picture.",
     "The outline is the part of the surface that this volume serves. The lobe on it is long where its paths leave "
     "often.",
     TourStep::kPicture},
    {"The directions of one volume",
     "The disc has a cell for every direction above the surface; its middle points straight away from the surface, "
     "its rim along it. Bright cells are those of bright light, as learned so far.",
     "Point at a bright cell, and see its ray in the picture.",
     "The ray ends where that light comes from. Paths leave through bright cells more often.", "learned disc"},
    {"Another scene is learned anew", "The knob moves the door. That is another scene with other light.",
     "Drag the knob 'opening'.", "Both pictures have begun again, and so has all that was learned.", "opening"},
    {"Another view is not", "What was learned belongs to the scene, not to the picture.",
     "Drag the picture to look around.",
     "Both pictures have begun again, but the left half knew the light already. Next brings the camera back.",
     TourStep::kPicture},
    {"Does learning pay?",
     "Not everywhere. With light samples every vertex also tests a point on a light; then both halves find light "
     "without luck.",
     "Wait until the table has a gain. Then press L for light samples, and wait for the second one.", "",
     "accuracy panel"},
}};

bool is_same_view(const CameraDescription& a, const CameraDescription& b) {
    return a.eye == b.eye && a.target == b.target;
}

/// Whether the scene of the window is rendered at the full size.
bool is_at_rest(const ViewerModel& model) {
    return model.status().picture != 0 && model.status().scene->source == model.scene().materials().file()->source;
}

bool has_both_gains(const ViewerModel& model) {
    const RunTable& table = model.comparison().accuracy().table();
    return learning_row(table, false) != nullptr && learning_row(table, true) != nullptr;
}

}  // namespace

std::span<const TourStep> tour_steps() { return kSteps; }

void GuidedTour::remember(int step, bool is_answered) {
    step_ = step >= 0 && step < kStepCount ? step : 0;
    is_answered_ = is_answered;
}

void GuidedTour::offer() {
    if (!is_answered_ && phase_ == Phase::Off) phase_ = Phase::Offered;
}

void GuidedTour::begin(ViewerModel& model) {
    is_answered_ = true;
    phase_ = Phase::Opening;
    model.render().set_paused(false);  // a paused renderer may never show the scene that prepare() waits for
    if (model.scene().name() != kScene) model.scene().open(kScene);
}

/// Everything that the steps point at is visible, and both methods begin with nothing: coarse passes of a camera that has just
/// come to rest would have trained the field on no clock.
void GuidedTour::prepare(ViewerModel& model) {
    PanelChoice& panels = model.window().panels;
    panels.shown = panels.settings = panels.right = panels.tabs = panels.accuracy = true;
    RenderControls& render = model.render();
    render.set_paused(false);
    render.set_view(View::Beauty);
    model.display().set_exposure(0.0f);
    render.set_next_event(false);
    render.set_method(learning_method());
    render.forget();
    model.selection().deselect();
    model.comparison().set_turns(true);
    model.comparison().set_mode(CompareMode::Split);
    phase_ = Phase::Running;
    start_step(model);
}

void GuidedTour::start_step(const ViewerModel& model) {
    before_ = {.split = model.comparison().state().split,
               .knobs = model.scene().shown().knobs,
               .camera = model.camera().camera()};
    knobs_ = before_.knobs;
    done_since_ = -1.0;
    is_seen_ = false;
}

/// The view of the step before comes back: the next step is about what it shows.
void GuidedTour::change_step(ViewerModel& model, int step) {
    if (step_ == kFly && !is_same_view(model.camera().camera(), before_.camera)) model.camera().set(before_.camera);
    step_ = step;
    forgets_ = step_ == kPays;  // both gains count all that learning costs
    start_step(model);
}

void GuidedTour::next_step(ViewerModel& model) {
    if (phase_ != Phase::Running) return;
    if (step_ + 1 == kStepCount) phase_ = Phase::Finished;
    change_step(model, (step_ + 1) % kStepCount);
}

void GuidedTour::last_step(ViewerModel& model) {
    if (phase_ == Phase::Running && step_ > 0) change_step(model, step_ - 1);
}

void GuidedTour::leave() {
    is_answered_ = true;
    phase_ = Phase::Off;
}

bool GuidedTour::is_done(const ViewerModel& model) const {
    switch (static_cast<Step>(step_)) {
    case kSplit: return model.comparison().state().split != before_.split;
    case kPick: return model.selection().inspection() != nullptr;
    case kDisc: return model.selection().hovered_cell() >= 0;
    case kKnob: return model.scene().shown().knobs != before_.knobs;
    case kFly: return !model.camera().is_moving() && !is_same_view(model.camera().camera(), before_.camera);
    case kPays: return has_both_gains(model);
    case kStepCount: break;
    }
    return false;
}

void GuidedTour::update(ViewerModel& model, double seconds) {
    const bool is_in_scene = model.scene().name() == kScene;
    if (phase_ == Phase::Opening) {
        if (is_in_scene && is_at_rest(model))
            prepare(model);
        else if (!is_in_scene && !model.scene().is_opening())
            leave();  // a message says why the scene cannot be opened
    }
    if (phase_ != Phase::Running) return;
    if (!is_in_scene) {
        leave();
        return;
    }
    if (step_ == kKnob && model.scene().shown().knobs != knobs_) {
        knobs_ = model.scene().shown().knobs;
        forgets_ = true;
    }
    const bool is_moved = model.camera().is_moving() || model.window().is_dragging;
    if (forgets_ && !is_moved && is_at_rest(model)) {
        model.render().forget();
        forgets_ = false;
    }
    if (!is_done(model))
        done_since_ = -1.0;
    else if (done_since_ < 0.0)
        done_since_ = seconds;
    else if (seconds - done_since_ >= kRestSeconds)
        is_seen_ = true;
}

std::string lesson_text(const ViewerModel& model) {
    const RunTable& table = model.comparison().accuracy().table();
    const auto factor = [&](bool next_event) {
        const RunRow* const row = learning_row(table, next_event);
        return row != nullptr ? ahead_text(*row) : std::string("not measured");
    };
    return fmt::format("In this room Reinforcement is, after the same time, without light samples: {}; with light "
                       "samples: {}.",
                       factor(false), factor(true));
}

std::string seen_text(const ViewerModel& model, int step) {
    if (step == kPays) return lesson_text(model);
    if (step != kSplit) return kSteps[static_cast<std::size_t>(step)].seen;
    const auto headline = model.comparison().headline();
    return headline ? headline->text : lesson_text(model);
}

std::string state_text(const GuidedTour& tour) {
    switch (tour.phase()) {
    case GuidedTour::Phase::Off: return "off";
    case GuidedTour::Phase::Offered: return "offered";
    case GuidedTour::Phase::Opening: return "opening";
    case GuidedTour::Phase::Running: return fmt::format("{}", tour.step() + 1);
    case GuidedTour::Phase::Finished: return "finished";
    }
    return "";
}

}  // namespace pl::ui
