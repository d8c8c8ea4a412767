// The part of RenderWorker that runs on the render thread.
#include <fmt/format.h>
#include <sys/resource.h>

#include "core/base/timer.h"
#include "ui/render_worker.h"

namespace pl {
namespace {

/// The window comes first where cores are few. On Linux this is about the calling thread, and threads that the back
/// end starts from it inherit it.
void yield_to_the_window() {
    constexpr int kNice = 3;
    (void)setpriority(PRIO_PROCESS, 0, kNice);
}

/// Does the edit change which volume a pixel shows?
bool changes_pose(const SessionEdit& edit) {
    return std::holds_alternative<EditCamera>(edit) || std::holds_alternative<EditScene>(edit) ||
           std::holds_alternative<EditField>(edit) || std::holds_alternative<EditLearned>(edit) ||
           std::holds_alternative<EditMaterial>(edit);
}

}  // namespace

void RenderWorker::run() {
    yield_to_the_window();
    if (!start_session()) return;
    while (take_wishes()) {
        if (!attempt([this] { work(); })) failed_ = true;
        update_status();
    }
    session_.reset();
}

bool RenderWorker::start_session() {
    const auto make = [this](std::shared_ptr<RenderBackend> backend) {
        return std::make_unique<Session>(std::move(backend), setup_.scene, setup_.settings, setup_.load_seconds);
    };
    try {
        session_ = backends_.start(make, [this](const WorkerMessage& message) { report(message); });
    } catch (...) {
        const std::lock_guard lock(mutex_);
        failure_ = std::current_exception();
        status_.state = WorkerState::Failed;
        return false;
    }
    settle_wish_for(setup_.first_backend);
    return true;
}

/// Waits until there is something to do; false if the window has closed.
bool RenderWorker::take_wishes() {
    std::vector<SessionEdit> edits;
    {
        std::unique_lock lock(mutex_);
        while (!wishes_.quit) {
            now_ = wishes_;
            if (!edits_.empty() || has_work()) break;
            status_ = make_status();
            wake_.wait(lock);
        }
        if (wishes_.quit) return false;
        edits = edits_.take();
        wishes_.pick.reset();
        wishes_.learned = false;
        wishes_.diagnostics = false;
        wishes_.steps = 0;
        stop_ = false;
    }
    apply_edits(std::move(edits));
    if (now_.backend != backends_.current()) change_backend();
    settle_turns();
    settle_trial();
    adopt_reference();
    const std::lock_guard lock(mutex_);
    // A pass in motion is short and always finished: otherwise a hand that never rests would never see a picture.
    pass_may_be_cut_ = !coarse();
    const bool other_frame = wishes_.display != now_.display || (wishes_.values && !now_.values);
    const bool is_late = !edits_.empty() || wishes_.turns != now_.turns || wishes_.backend != backends_.current() ||
                         (other_frame && status_.passes > 0);
    if (pass_may_be_cut_ && is_late) stop_ = true;  // came while nobody had decided
    return true;
}

bool RenderWorker::has_work() const {
    const bool other_turns = now_.turns.has_value() != turns_.has_value();
    const bool other_trial = now_.trial != (trial_ ? std::optional(trial_->forced) : std::nullopt);
    if (now_.pick || now_.learned || now_.diagnostics || other_turns || other_trial || now_.reference != reference_ ||
        now_.backend != backends_.current())
        return true;
    if (frame_is_stale()) return true;
    if (failed_) return false;
    const bool size_is_stale = divider_ != 1 && !coarse();
    return size_is_stale || wants_pass() || republish_ || inspection_stale_ ||
           now_.volume != (inspection_ ? inspection_->volume : kNoVolume) || (now_.cells && !cells_are_current());
}

void RenderWorker::apply_edits(std::vector<SessionEdit> edits) {
    for (const SessionEdit& edit : edits) {
        failed_ = false;
        if (changes_pose(edit)) ++pose_;
        pose_unseen_ = pose_unseen_ || std::holds_alternative<EditCamera>(edit);
        inspection_stale_ = true;
        republish_ = true;
        attempt([&] { apply(edit); });
    }
}

/// May be done twice, if a back end fails in between.
void RenderWorker::apply(const SessionEdit& edit) {
    if (const auto* scene = std::get_if<EditScene>(&edit)) diagonal_ = bounds_of(*scene->scene).diagonal();
    if (const auto* size = std::get_if<EditSize>(&edit)) {
        full_width_ = size->width;
        full_height_ = size->height;
        divider_ = 0;  // no size is right any more: work() applies the new one
    } else {
        session_->apply(edit);
    }
    if (const auto* effects = std::get_if<EditEffects>(&edit)) forced_ = effects->forced;
}

/// Does a step. If a back end fails in it, another takes over and does it again. False if it cannot be done: then the
/// reason is told.
bool RenderWorker::attempt(const std::function<void()>& step) {
    for (;;) {
        try {
            step();
            return true;
        } catch (const std::exception& error) {
            if (backends_.on_fallback() || !is_fault_of_backend(error)) {
                report({true, error.what()});
                return false;
            }
            if (!take_over(error)) return false;
        }
    }
}

/// Messages come last: whoever reads one sees the state that it tells of.
void RenderWorker::change_backend() {
    const std::string wanted = now_.backend;
    WorkerMessage message;
    try {
        message = backends_.switch_to(*session_, wanted);
        backend_changed();
    } catch (const std::exception& error) {
        message = {true, fmt::format("cannot switch to {}: {}. {} goes on", back_end_label(wanted),
                                     reason_of(error, wanted), back_end_label(backends_.current()))};
    }
    settle_wish_for(wanted);
    report(std::move(message));
}

bool RenderWorker::take_over(const std::exception& error) {
    const std::string failed = backends_.current();
    WorkerMessage message;
    try {
        message = backends_.take_over(*session_, error);
    } catch (const std::exception& second) {
        report({true, fmt::format("{} failed: {}. No other back end can take over: {}", back_end_label(failed),
                                  reason_of(error, failed), second.what())});
        return false;
    }
    backend_changed();
    settle_wish_for(failed);
    report(std::move(message));
    return true;
}

void RenderWorker::backend_changed() {
    failed_ = false;
    inspection_stale_ = true;
    republish_ = true;
    motion_.reset();
    update_status();
}

/// A wish for this back end is settled, whatever came of it; a newer one stands.
void RenderWorker::settle_wish_for(const std::string& backend) {
    const std::lock_guard lock(mutex_);
    if (wishes_.backend == backend) wishes_.backend = backends_.current();
    if (now_.backend == backend) now_.backend = backends_.current();
}

void RenderWorker::apply_size(int divider) {
    if (divider == divider_) return;
    divider_ = divider;
    const int width = divided(full_width_, divider);
    const int height = divided(full_height_, divider);
    if (session_->settings().width == width && session_->settings().height == height) return;
    session_->apply(EditSize{width, height});
    ++pose_;
}

void RenderWorker::work() {
    apply_size(coarse() ? motion_.divider_for(full_width_, full_height_) : 1);
    if ((republish_ || frame_is_stale()) && session_->passes() > 0) {  // a parked picture is there at once
        settle_frame_wish();
        refresh_inspection();
        publish();
    }
    if (now_.pick) answer_pick(*now_.pick);
    if (now_.learned) answer_learned();
    if (now_.diagnostics) answer_diagnostics();
    if (turns_) take_turn();
    if (wants_pass()) render();
    if (stop_) return;
    if (now_.cells && !cells_are_current() && session_->passes() > 0) render_cells();
    refresh_inspection();
    if (republish_ || publish_is_due()) publish();
}

/// Before the frame is made: one that fails is told once, not for ever.
void RenderWorker::settle_frame_wish() {
    published_display_ = now_.display;
    published_values_ = now_.values;
}

/// Is what was published not what the window wants to see of the same picture?
bool RenderWorker::frame_is_stale() const {
    if (session_->passes() == 0) return false;
    return now_.display != published_display_ || (now_.values && !published_values_);
}

/// While the camera moves, and until the last place it came to was seen at all.
bool RenderWorker::coarse() const { return now_.low_resolution && (now_.moving || pose_unseen_); }

bool RenderWorker::wants_pass() const {
    if (failed_) return false;
    // Also a paused picture follows the camera: one pass for every view of the scene.
    if (session_->passes() == 0 || now_.steps > 0) return true;
    return !now_.paused && !limit_reached();
}

bool RenderWorker::limit_reached() const {
    if (coarse()) return false;
    if (!turns_) return is_enough(session_->passes(), work_seconds(session_->clocks()));
    const auto side = side_at_limit();
    return side && is_enough(turns_->status.passes[*side], turns_->status.seconds[*side]);
}

bool RenderWorker::is_enough(std::uint32_t passes, double seconds) const {
    const SampleLimits& limits = now_.limits;
    return (limits.spp > 0 && passes >= limits.spp) || (limits.seconds > 0.0 && seconds >= limits.seconds);
}

void RenderWorker::render() {
    const Stopwatch watch;
    begin_trial_pass();
    const Progress progress = session_->advance(&stop_);
    end_trial_pass(progress);
    if (progress == Progress::Rendered) {
        if (session_->passes() == 1) republish_ = true;
        motion_.observe(divider_, watch.seconds());
    }
    observe_run();
    if (turns_) count_turn(turns_->side);
    update_status();
    if (now_.steps > 0 || limit_reached() || now_.paused) republish_ = true;
}

}  // namespace pl
