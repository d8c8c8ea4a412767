// The render thread's side of RenderWorker: owns the session and renders it piece by piece, by the requests in the
// inbox, with frames, status and answers into the outbox.
#pragma once

#include "ui/worker/backend_switch.h"
#include "ui/worker/cell_image.h"
#include "ui/worker/denoised_preview.h"
#include "ui/worker/field_history.h"
#include "ui/worker/frame_schedule.h"
#include "ui/worker/inbox.h"
#include "ui/worker/inspection.h"
#include "ui/worker/method_turns.h"
#include "ui/worker/outbox.h"
#include "ui/worker/picture_size.h"
#include "ui/worker/recorder.h"

namespace pl::ui {

struct WorkerSetup {
    BackendSwitch::Make make_backend;
    BackendChoices backends;
    std::string first_backend;
    std::shared_ptr<const SceneDescription> scene;
    RenderSettings settings;
    SampleLimits limits;
    double load_seconds = 0.0;
    DisplaySettings display{};
    std::shared_ptr<const LearnedField> learned = nullptr;  ///< that the first picture begins with; may be null
};

class RenderLoop {
public:
    RenderLoop(const WorkerSetup& setup, Inbox& inbox, Outbox& outbox);

    /// Runs until the inbox requests the end, or the session cannot be made.
    void run(const WorkerSetup& setup);

private:
    bool start_session(const WorkerSetup& setup);
    bool take_requests();
    bool has_work() const;
    void settle_turns();
    void make_second();
    void follow(const SessionEdit& edit);
    Preview wanted_preview() const;
    void settle_preview(Preview wanted);
    void adopt_reference();
    void apply_edits(const std::vector<WorkerEdit>& edits);
    void apply(const WorkerEdit& edit);
    void apply(const SessionEdit& edit);

    void work();
    void take_turn();
    void render();
    void answer_questions();
    void refresh_inspection();
    bool wants_pins() const;
    void note_placement();
    void observe_field();
    void publish();
    bool wants_pass() const;
    std::optional<std::size_t> unmeasured_side() const;
    bool limit_reached() const;
    std::uint32_t most_passes() const;
    bool is_publishing_due() const;
    bool holds_frames_back() const;

    bool attempt(const std::function<void()>& step);
    void change_backend();
    bool take_over(const std::exception& error);
    void backend_changed();
    void settle_backend(const std::string& asked);

    /// The film under way, and its session.
    FilmSlot slot() const { return slot_of_side(turns_ ? turns_->side() : 0); }
    FilmSlot slot_of_side(std::size_t side) const {
        return turns_ ? FilmSlot{turns_->status().sides.methods[side], shown_.view}
                      : preview_.slot(*session_, shown_);
    }
    Session& session_of(std::size_t side) const { return side == 1 && second_ ? *second_ : *session_; }
    Session& at_work() const { return session_of(turns_ ? turns_->side() : 0); }
    std::uint32_t passes() const { return at_work().passes(slot()); }
    double seconds() const { return work_seconds(at_work().clocks(slot())); }
    /// The method of answers and inspections, and its film.
    MethodId asked_method() const { return turns_ ? turns_->first() : shown_.method; }
    FilmSlot asked_slot() const { return turns_ ? FilmSlot{turns_->first(), shown_.view} : slot(); }
    bool is_coarse() const { return size_.is_coarse(now_); }
    WorkerState state_of(const WorkerStatus& status) const;
    WorkerStatus make_status() const;
    void update_status();

    Inbox& inbox_;
    Outbox& outbox_;
    BackendSwitch backends_;
    std::unique_ptr<Session> session_;
    Requests now_;    ///< as last taken
    FilmSlot shown_;  ///< method and view of the window, apart from turns
    PictureSize size_;
    std::optional<MethodTurns> turns_;
    std::unique_ptr<Session> second_;  ///< of the second side of turns, if its settings are others
    MotionPreview preview_;
    DenoisedPreview denoised_;
    Recorder runs_;
    CellRenderer cells_;
    // The parts of the learned field that the window shows.
    Inspection selected_{};
    std::vector<Inspection> pins_{};  ///< in the order of Requests::pins
    FieldHistoryRecorder history_{};
    std::shared_ptr<const HostVolumes> volumes_{};  ///< whose numbers the window knows
    std::uint64_t placement_ = 0;                   ///< WorkerStatus::placement of them

    FrameSchedule frames_;
    SceneFacts facts_;              ///< of the session's scene
    std::uint64_t all_passes_ = 0;  ///< of every film, since the start
    bool failed_ = false;
};

}  // namespace pl::ui
