// The state of the viewer without its window, as objects of one concern each: keys, menus, panels and scripts call the
// object concerned. Lives on the window's thread.
#pragma once

#include <memory>
#include <string>

#include "ui/model/bookmarks.h"
#include "ui/model/compare_controls.h"
#include "ui/model/diagnostics_search.h"
#include "ui/model/display_controls.h"
#include "ui/model/effects_model.h"
#include "ui/model/field_flowers.h"
#include "ui/model/gain_marks.h"
#include "ui/model/guided_tour.h"
#include "ui/model/history.h"
#include "ui/model/open_dialog.h"
#include "ui/model/outside_view.h"
#include "ui/model/past_film.h"
#include "ui/model/path_explorer.h"
#include "ui/model/self_test.h"
#include "ui/model/window_state.h"

namespace pl::ui {

class ViewerModel {
public:
    /// `settings` hold the final size and camera.
    ViewerModel(const ViewerOptions& options, std::shared_ptr<const SceneDescription> scene,
                const RenderSettings& settings, double load_seconds);
    /// Pictures and fields that are still to be saved are written first.
    ~ViewerModel();
    ViewerModel(const ViewerModel&) = delete;
    ViewerModel& operator=(const ViewerModel&) = delete;

    /// Once per frame of the window, with its clock: takes the results of the other threads, ends motion, drops
    /// expired messages. Throws the error that ended the render thread.
    void update(double seconds);

    /// Null before the first frame.
    const PublishedFrame* frame() const { return link_.frame().get(); }
    const WorkerStatus& status() const { return link_.status(); }

    Messages& messages() { return messages_; }
    const Messages& messages() const { return messages_; }
    const RenderLink& link() const { return link_; }
    WindowState& window() { return window_; }
    const WindowState& window() const { return window_; }
    DisplayControls& display() { return display_; }
    const DisplayControls& display() const { return display_; }
    CameraMotion& camera() { return camera_; }
    const CameraMotion& camera() const { return camera_; }
    Selection& selection() { return selection_; }
    const Selection& selection() const { return selection_; }
    RenderControls& render() { return render_; }
    const RenderControls& render() const { return render_; }
    ViewedScene& scene() { return scene_; }
    const ViewedScene& scene() const { return scene_; }
    const EffectsModel& effects() const { return effects_; }
    References& references() { return references_; }
    const References& references() const { return references_; }
    CompareControls& comparison() { return comparison_; }
    const CompareControls& comparison() const { return comparison_; }
    DiagnosticsSearch& diagnostics() { return diagnostics_; }
    const DiagnosticsSearch& diagnostics() const { return diagnostics_; }
    SelfTestControl& self_test() { return self_test_; }
    const SelfTestControl& self_test() const { return self_test_; }
    Files& files() { return files_; }
    const Files& files() const { return files_; }
    OpenDialog& open_dialog() { return open_dialog_; }
    const OpenDialog& open_dialog() const { return open_dialog_; }
    GuidedTour& tour() { return tour_; }
    const GuidedTour& tour() const { return tour_; }
    const OutsideView& outside() const { return outside_; }
    LearningTime& time() { return time_; }
    const LearningTime& time() const { return time_; }
    FieldFlowers& flowers() { return flowers_; }
    const FieldFlowers& flowers() const { return flowers_; }
    GainMarks& gain_marks() { return gain_marks_; }
    const GainMarks& gain_marks() const { return gain_marks_; }
    PathExplorer& paths() { return paths_; }
    const PathExplorer& paths() const { return paths_; }
    AutoExposure& exposure() { return exposure_; }
    const AutoExposure& exposure() const { return exposure_; }
    CameraBookmarks& bookmarks() { return bookmarks_; }
    const CameraBookmarks& bookmarks() const { return bookmarks_; }
    CameraFlight& flight() { return flight_; }
    const CameraFlight& flight() const { return flight_; }
    History& history() { return history_; }
    const History& history() const { return history_; }
    PastFilm& past_film() { return past_film_; }
    const PastFilm& past_film() const { return past_film_; }
    SequenceWriter& sequence() { return sequence_; }
    const SequenceWriter& sequence() const { return sequence_; }

    /// The center of orbits: the picked point, else the camera's target.
    Vec3f orbit_center() const;

    /// Background work or unsaved files.
    bool busy() const;
    /// Whether the picture is shown denoised: never beside another, pixel by pixel, or in a file.
    bool shows_denoised() const;
    /// The window's title.
    std::string title() const;
    /// Whether a dialog lies over the window: it has the keyboard.
    bool has_dialog() const {
        return window_.help || window_.about || open_dialog_.is_shown() || self_test_.is_shown();
    }
    /// Closes, stops or deselects the topmost of all that can be: the action of Esc.
    void cancel();

private:
    Messages messages_;
    Jobs jobs_;
    RenderLink link_;
    WindowState window_;
    DisplayControls display_;
    CameraMotion camera_;
    Selection selection_;
    RenderControls render_;
    ViewedScene scene_;
    EffectsModel effects_;
    References references_;
    CompareControls comparison_;
    DiagnosticsSearch diagnostics_;
    SelfTestControl self_test_;
    Files files_;
    OpenDialog open_dialog_;
    GuidedTour tour_;
    PathExplorer paths_;
    OutsideView outside_;
    LearningTime time_;
    FieldFlowers flowers_;
    PastFilm past_film_;
    GainMarks gain_marks_;
    AutoExposure exposure_;
    CameraBookmarks bookmarks_;
    CameraFlight flight_;
    SequenceWriter sequence_;
    History history_;
};

}  // namespace pl::ui
