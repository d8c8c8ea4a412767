// The state of the viewer and everything that can be done to it, without window: keys, menus, panels and scripts all
// call the same functions. Lives on the window's thread.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ui/accuracy/accuracy_model.h"
#include "ui/background_job.h"
#include "ui/camera_controls.h"
#include "ui/compare/compare_plan.h"
#include "ui/diagnostics_finder.h"
#include "ui/edited_materials.h"
#include "ui/effects_model.h"
#include "ui/job_thread.h"
#include "ui/numbered_names.h"
#include "ui/overlays/direction_disc.h"
#include "ui/plot/plot_drag.h"
#include "ui/worker/render_worker.h"
#include "ui/self_test_run.h"
#include "ui/viewer.h"

namespace pl {

enum class LogLevel { Info, Warning, Error };

struct LogLine {
    double seconds;  ///< since the start
    LogLevel level;
    std::string text;
};

/// A message over the picture that goes away by itself.
struct Toast {
    LogLevel level;
    std::string text;
    double until;  ///< on the window's clock
};

/// Look of the window: nothing in it reaches the rendering.
struct WindowState {
    bool panels = true;
    bool accuracy = true;  ///< the panel with the plot
    PlotDrag plot_drag = PlotDrag::None;
    bool over_plot = false;  ///< the wheel is the plot's
    Rect plot;               ///< where its curves are
    CompareState compare;
    bool help = false;
    bool self_test = false;
    bool cells = false;
    float cells_opacity = 0.4f;
    bool hemisphere = true;
    bool low_resolution = true;  ///< allowed while the camera moves
    float ui_scale = 1.0f;
    CellQuantity quantity = CellQuantity::Radiance;
    ColorScale scale = ColorScale::Logarithmic;  ///< a lamp is brighter than all the rest together
    int hovered_cell = -1;                       ///< of the selected volume's disk
    bool values_shown = false;                   ///< the numbers of a pixel
    double speed_shown_until = 0.0;
    bool full_screen_asked = false;
    bool window_shot_asked = false;
    bool quit_asked = false;
    bool fit_size_asked = false;    ///< make the picture as large as the window has room for
    bool volume_tab_asked = false;  ///< bring it to the front
};

/// Of learned fields that the viewer saves.
inline constexpr std::string_view kFieldSuffix = ".field";

class ViewerModel {
public:
    /// `settings` hold the final size and camera.
    ViewerModel(const ViewerOptions& options, std::shared_ptr<const SceneDescription> scene,
                const RenderSettings& settings, double load_seconds);
    /// Waits a moment for the numbers of a picture that was asked to be saved; it is written then.
    ~ViewerModel();
    ViewerModel(const ViewerModel&) = delete;
    ViewerModel& operator=(const ViewerModel&) = delete;

    /// Once per frame of the window: takes what the other threads have, ends motion, drops old messages.
    /// Throws what ended the render thread.
    void update(double seconds);

    const PublishedFrame* frame() const { return frame_.get(); }
    const WorkerStatus& status() const { return status_; }
    const RenderSettings& settings() const { return settings_; }
    const DisplaySettings& display() const { return display_; }
    const SampleLimits& limits() const { return limits_; }
    const CameraControls& controls() const { return controls_; }
    const std::vector<LogLine>& log() const { return log_; }
    const std::vector<Toast>& toasts() const { return toasts_; }
    const std::string& scene_name() const { return scene_name_; }
    const ViewerOptions& options() const { return options_; }
    WindowState& window() { return window_; }
    const WindowState& window() const { return window_; }
    bool paused() const { return paused_; }
    bool moving() const { return moving_; }
    bool busy() const {
        return jobs_.pending() > 0 || !unsaved_.empty() || reference_job_ != nullptr || diagnostics_.is_searching() ||
               self_test_.is_running();
    }
    double now() const { return now_; }
    std::int32_t selected_volume() const { return selected_volume_; }
    const std::optional<PickedPoint>& picked() const { return picked_; }
    const EffectsModel& effects() const { return effects_; }
    /// Effects whose cost is being measured.
    std::optional<FeatureSet> measuring_effects() const { return measuring_; }
    const EditedMaterials& materials() const { return materials_; }
    /// That of the surface that was picked last, or chosen from the list.
    std::optional<std::uint32_t> selected_material() const { return selected_material_; }
    /// Learned table of the selected volume, or null.
    const VolumeInspection* inspection() const;
    /// Million camera paths per second, of the last half second of rendering or more.
    double mpaths_per_second() const { return mpaths_per_second_; }
    /// Number of the newest camera edit; 0 before the first.
    std::uint64_t camera_generation() const { return camera_generation_; }
    /// The back end that was asked for last; the one in use is in status().
    std::string wanted_backend() const { return worker_.wanted_backend(); }
    /// Number of the newest change of back end; 0 before the first.
    std::uint64_t backend_generation() const { return backend_generation_; }
    /// The runs of this session as the accuracy panel shows them.
    AccuracyModel& accuracy() { return accuracy_; }
    const AccuracyModel& accuracy() const { return accuracy_; }
    /// Null without one for the picture in the window.
    const ReferencePicture* reference() const;
    /// What a comparison shows in `view`; no tiles if there is none.
    /// Of the one that is being made; empty if none is.
    std::optional<ReferenceJob::Progress> reference_progress() const;
    ComparePlan compare_plan(const Rect& view) const;
    bool turns() const { return turns_.has_value(); }
    std::string title() const;
    ViewerPicture picture() const {
        return {scene_name_, status_.backend, asked_settings(), display_, limits_, materials_.edited_names()};
    }
    /// Of the scene as in its files, whatever was changed in it.
    std::string command_line() const;

    void set_method(MethodId method);
    void set_view(View view);
    void step_view(int steps);
    void set_backend(const std::string& name);
    void next_backend();
    void set_next_event(bool on);
    void set_max_depth(int depth);
    void set_roulette(RouletteRule rule);
    void set_seed(std::uint64_t seed);
    void set_mixture(MixtureSettings mixture);
    void set_field(const FieldSettings& field);
    void set_size(int width, int height);
    void set_limits(const SampleLimits& limits);
    void set_paused(bool paused);
    void single_pass();
    void restart();
    void forget();
    void cancel();  ///< what Esc does
    void cancel_precomputation();

    void set_forced_effects(FeatureSet forced);
    /// What being able to do these, too, costs per pass: measured on the running picture, which stays the same.
    void measure_effects(FeatureSet forced);
    void stop_measuring_effects();

    void set_compare_mode(CompareMode mode);
    void step_compare(int steps);
    void flip();  ///< to the other picture of a comparison
    void choose_side(bool second, const SideChoice& choice);
    void set_split(float share);
    /// Pictures are compared where the cursor stands, so that it turns comparing on.
    void set_cursor(const Cursor& cursor);
    /// Makes a reference of the picture in the window, or goes on with the stored one. Rendering rests meanwhile.
    void make_reference();
    void stop_reference();
    /// The present method and what it is compared with render in turns of equal time.
    void set_turns(bool on);

    /// Where something went wrong in the picture; null until that was looked for, and when the picture is another one.
    std::shared_ptr<const DiagnosticsMap> diagnostics() const;
    /// The share of the search that is done; empty if there is none.
    std::optional<double> diagnostics_share() const {
        return diagnostics_.is_searching() ? std::optional(diagnostics_.share()) : std::nullopt;
    }
    void find_diagnostics();    ///< rendering rests meanwhile
    void toggle_diagnostics();  ///< shows where it was, or ends that
    const SelfTestRun& self_test() const { return self_test_; }
    void start_self_test();  ///< rendering rests meanwhile
    void stop_self_test();

    void set_exposure(float ev);
    void set_curve(ToneCurve curve);
    void set_cells(bool on);
    void set_cells_opacity(float opacity);
    void set_low_resolution(bool allowed);

    void fly(const MoveKeys& keys, double seconds);
    void look(Vec2f pixels);
    void change_speed(float notches);
    void camera_home();
    void set_camera(const CameraDescription& camera);
    /// Makes the lens sharp at the point that was picked, if there is one.
    void focus_on_picked();

    void pick(Vec2f image_point);
    void deselect();

    void select_material(std::uint32_t index);
    /// A bad value is refused with the reason, and the old material stays.
    void set_material(std::uint32_t index, const MaterialDescription& material);
    void restore_material(std::uint32_t index);  ///< as in the file
    void restore_materials();

    void reload();
    /// A scene, or a learned field of the scene that is open: a file that ends in kFieldSuffix.
    void open(const std::string& file);
    void save_field();
    void load_field(const std::filesystem::path& path);
    /// The newest one that was saved of this scene.
    void load_last_field();
    void save_screenshot();
    void save_picture();
    /// What the window shows; read by the window, because only it can.
    void save_window(ScreenPixels pixels, std::filesystem::path path);
    std::filesystem::path next_window_shot();

    void say(LogLevel level, const std::string& text);   ///< toast and log
    void note(LogLevel level, const std::string& text);  ///< log only

private:
    RenderSettings asked_settings() const;
    void touch_motion();
    void submit_camera();
    void submit_estimator();
    void take_pick();
    void take_effects();
    void measure_throughput();
    void adopt_scene(std::shared_ptr<const SceneDescription> scene, const std::string& name, bool keep_camera);
    void start_loading(const std::string& name, bool keep_camera);
    void save(std::initializer_list<const char*> suffixes);
    void write_unsaved();
    void take_learned();
    void adopt_field(const std::shared_ptr<LearnedField>& field, const std::filesystem::path& path);
    std::string file_stem() const;
    void push_job(std::function<JobThread::Report()> job);
    void take_frame();
    void take_runs();
    void look_for_reference();
    void adopt_reference(const std::shared_ptr<const StoredReference>& found);
    void take_reference();
    void take_diagnostics();
    void take_self_test();
    void hold_rendering();
    CompareInput compare_input() const;
    CompareSides sides_in_turns() const;
    void select(std::int32_t volume);
    OpenScene open_scene() const;

    const ViewerOptions& options_;
    std::string scene_name_;
    RenderSettings settings_;
    DisplaySettings display_;
    SampleLimits limits_;
    CameraControls controls_;
    WindowState window_;
    double now_ = 0.0;
    bool paused_ = false;
    bool moving_ = false;
    double moving_until_ = -1.0;
    MethodId previous_method_ = MethodId::Default;
    std::uint64_t camera_generation_ = 0;
    std::uint64_t backend_generation_ = 0;
    std::int32_t selected_volume_ = kNoVolume;
    std::optional<PickedPoint> picked_;
    EditedMaterials materials_;
    EffectsModel effects_;
    std::optional<FeatureSet> measuring_;
    std::optional<std::uint32_t> selected_material_;
    std::vector<LogLine> log_;
    std::vector<Toast> toasts_;
    NumberedNames names_;
    std::vector<std::filesystem::path> unsaved_;  ///< waiting for a frame with values
    double save_deadline_ = 0.0;
    std::shared_ptr<const PublishedFrame> frame_;
    AccuracyModel accuracy_;
    std::optional<ReferencePicture> reference_;  ///< the newest that was found or made; maybe of another picture
    std::uint64_t looked_for_ = 0;               ///< picture that a reference was last looked for
    std::optional<TurnMethods> turns_;
    std::shared_ptr<const PublishedFrame> turn_frame_;  ///< of the second method in turns; frame_ is of the first
    std::shared_ptr<const PublishedFrame> latest_;      ///< the newer one of both
    WorkerStatus status_;
    double mpaths_per_second_ = 0.0;
    FilmSlot measured_slot_;
    std::string measured_backend_;
    std::uint64_t measured_paths_ = 0;
    double measured_seconds_ = 0.0;

    RenderWorker worker_;
    std::unique_ptr<ReferenceJob> reference_job_;
    DiagnosticsFinder diagnostics_;
    SelfTestRun self_test_;
    JobThread jobs_;  ///< last: its reports use what is above
};

}  // namespace pl
