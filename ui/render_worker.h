// The render thread. It owns the session; the window sends edits and wishes, and takes published frames.
// Every public function may be called from any thread and returns at once.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

#include "core/measure/live_runs.h"
#include "core/session/session.h"
#include "ui/backend_switch.h"
#include "ui/compare/turns.h"
#include "ui/edit_queue.h"
#include "ui/motion_resolution.h"
#include "ui/published_frame.h"
#include "ui/viewer.h"
#include "ui/worker/cell_colors.h"

namespace pl {

struct WorkerSetup {
    BackendSwitch::Make make_backend;
    BackendChoices backends;
    std::string first_backend;
    std::shared_ptr<const SceneDescription> scene;
    RenderSettings settings;
    SampleLimits limits;
    double load_seconds = 0.0;
    DisplaySettings display{};
};

/// What the render thread knows of two methods in turns.
struct TurnsState {
    static constexpr double kTurnSeconds = 0.25;

    TurnsStatus status;
    Turns order{kTurnSeconds};
    std::size_t side = 0;              ///< whose turn it is
    std::optional<FieldStatus> field;  ///< of the first method
};

/// What the render thread knows of effects whose cost is being measured.
struct EffectTrial {
    FeatureSet forced;
    PairedCost cost;
    std::array<std::string, 2> kernels;            ///< without and with them
    std::pair<std::uint64_t, std::string> film{};  ///< number of the picture, and the back end that has it
    double seconds_before = 0.0;                   ///< the picture's, when the pass under way began
    bool in_pass = false;
    bool disturbed = false;  ///< the pass under way was interrupted
};

class RenderWorker {
public:
    /// Memory for pictures of runs.
    static constexpr std::size_t kRunPictureBytes = std::size_t{256} << 20;

    explicit RenderWorker(WorkerSetup setup);
    ~RenderWorker();
    RenderWorker(const RenderWorker&) = delete;
    RenderWorker& operator=(const RenderWorker&) = delete;

    /// Queues an edit and returns its number: frames that show it have at least this generation.
    std::uint64_t submit(SessionEdit edit);
    /// Asks for another back end; returns a number like submit(). Where it cannot be had, a message says why, and all
    /// stays as it is.
    std::uint64_t switch_backend(const std::string& name);
    /// The back end that was asked for last, or the one in use if that could not be had.
    std::string wanted_backend() const;
    /// While the camera moves, pictures may be coarse; afterwards they are complete again.
    void set_moving(bool moving);
    void set_low_resolution_allowed(bool allowed);
    void set_paused(bool paused);
    /// One more pass while paused.
    void step();
    void set_limits(SampleLimits limits);
    /// How frames are shown from now on; interrupts a pass at rest, which then goes on where it was.
    void set_display(const DisplaySettings& display);
    /// Whether frames carry the numbers behind the picture, which take their time to fetch from a device.
    void set_values_wanted(bool wanted);
    /// What runs are measured against from now on, where they show the same picture; null for nothing.
    void set_reference(std::shared_ptr<const LiveReference> reference);
    /// Lets two methods render in turns of equal charged time; nothing ends it, and leaves the method of the last turn.
    void set_turns(std::optional<TurnMethods> methods);
    /// Measures what forcing these effects costs; nothing ends it. Not while methods are in turns. WorkerStatus tells.
    void measure_effects(std::optional<FeatureSet> forced);
    /// Whether frames carry the image of the volumes' cells.
    void set_cells_wanted(bool wanted);
    /// Asks for the surface under a point of the image, in [0,1)^2 from the top left.
    void request_pick(Vec2f image_point);
    /// Asks for what the method has learned, after the pass under way.
    void request_learned();
    /// Asks for what it takes to look for diagnostics in the picture, after the pass under way.
    void request_diagnostics();
    /// The volume whose inspection frames carry; kNoVolume for none.
    void select_volume(std::int32_t volume);

    std::shared_ptr<const PublishedFrame> latest();
    /// Number of frames published so far.
    std::uint64_t frame_count() const { return frame_count_.load(std::memory_order_acquire); }
    WorkerStatus status() const;
    /// Error against time of everything rendered so far; never null.
    std::shared_ptr<const LiveRunSet> runs() const;
    std::vector<WorkerMessage> take_messages();
    std::optional<PickAnswer> take_pick();
    std::optional<LearnedAnswer> take_learned();
    std::optional<DiagnosticsAnswer> take_diagnostics();
    /// What ended the thread, or null. Only a session that cannot be made ends it.
    std::exception_ptr failure() const;

private:
    /// What the window asked for; guarded by mutex_.
    struct Wishes {
        bool quit = false;
        bool moving = false;
        bool paused = false;
        bool low_resolution = true;
        bool cells = false;
        bool values = false;
        DisplaySettings display;
        int steps = 0;
        SampleLimits limits;
        std::int32_t volume = kNoVolume;
        std::optional<Vec2f> pick;
        bool learned = false;
        bool diagnostics = false;
        std::optional<TurnMethods> turns;
        std::optional<FeatureSet> trial;  ///< effects that are measured
        std::shared_ptr<const LiveReference> reference;
        std::string backend;
        std::uint64_t generation = 0;
    };

    void run();
    bool start_session();
    bool take_wishes();
    bool has_work() const;
    void apply_edits(std::vector<SessionEdit> edits);
    void apply(const SessionEdit& edit);
    bool attempt(const std::function<void()>& step);
    void change_backend();
    bool take_over(const std::exception& error);
    void backend_changed();
    void settle_wish_for(const std::string& backend);
    void apply_size(int divider);
    void cut_for_a_frame();
    void settle_turns();
    void read_turns();
    void take_turn();
    std::optional<std::size_t> side_at_limit() const;
    void count_turn(std::size_t side);
    void settle_trial();
    void begin_trial_pass();
    void end_trial_pass(Progress progress);
    std::optional<EffectCost> effect_cost() const;
    static LiveRuns make_runs();
    void observe_run();
    void note_picture();
    void adopt_reference();
    void work();
    void render();
    void render_cells();
    /// Whether cells_ shows the present volumes from the present place.
    bool cells_are_current() const { return cells_pose_ == pose_ && cells_refinement_ == session_->refinement(); }
    void answer_pick(Vec2f image_point);
    void answer_learned();
    void answer_diagnostics();
    void refresh_inspection();
    void publish();
    bool publish_is_due() const;
    bool frame_is_stale() const;
    void settle_frame_wish();
    bool limit_reached() const;
    bool is_enough(std::uint32_t passes, double seconds) const;
    bool coarse() const;
    bool wants_pass() const;
    WorkerStatus make_status() const;
    void update_status();
    void report(WorkerMessage message);

    WorkerSetup setup_;

    mutable std::mutex mutex_;
    std::condition_variable wake_;
    Wishes wishes_;
    EditQueue edits_;
    WorkerStatus status_;
    std::vector<WorkerMessage> messages_;
    std::optional<PickAnswer> pick_answer_;
    std::optional<LearnedAnswer> learned_answer_;
    std::optional<DiagnosticsAnswer> diagnostics_answer_;
    std::shared_ptr<const LiveRunSet> run_set_;
    std::shared_ptr<const PublishedFrame> frame_;
    bool frame_taken_ = true;
    bool pass_may_be_cut_ = false;  ///< the pass under way is one at rest: a new camera stops it
    std::exception_ptr failure_;
    std::atomic<std::uint64_t> frame_count_{0};
    StopFlag stop_{false};

    // Only the render thread touches what follows.
    BackendSwitch backends_;
    std::unique_ptr<Session> session_;
    Wishes now_;  ///< wishes as of the last look
    float diagonal_ = 0.0f;
    MotionResolution motion_;
    std::optional<TurnsState> turns_;
    std::optional<EffectTrial> trial_;
    FeatureSet forced_;  ///< effects that a person forces; a trial goes its own way meanwhile
    LiveRuns runs_ = make_runs();
    std::shared_ptr<const LiveReference> reference_;
    std::uint64_t picture_ = 0;             ///< picture_key(); 0 while it is coarse
    std::uint64_t picture_generation_ = 0;  ///< FilmOrigin::generation that picture_ belongs to
    int full_width_ = 0;
    int full_height_ = 0;
    int divider_ = 1;
    std::uint64_t pose_ = 1;        ///< grows with everything that changes which cell a pixel sees
    std::uint64_t cells_pose_ = 0;  ///< pose that cells_ shows
    Refinement cells_refinement_;   ///< of the volumes that it shows
    std::shared_ptr<const CellImage> cells_;
    std::shared_ptr<const VolumeInspection> inspection_;
    bool inspection_stale_ = false;
    bool pose_unseen_ = false;  ///< the camera went to a place that no frame shows yet
    bool republish_ = false;    ///< the published frame lacks something that is there now
    bool failed_ = false;
    double inspected_at_ = 0.0;
    double published_at_ = 0.0;
    std::uint32_t published_passes_ = 0;
    DisplaySettings published_display_;
    bool published_values_ = false;

    std::thread thread_;  ///< last: starts when all else is there
};

}  // namespace pl
