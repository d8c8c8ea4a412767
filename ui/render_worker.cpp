#include "ui/render_worker.h"

namespace pl {

const char* name_of(WorkerState state) {
    switch (state) {
    case WorkerState::Starting: return "starting";
    case WorkerState::Rendering: return "rendering";
    case WorkerState::Precomputing: return "precomputing";
    case WorkerState::Paused: return "paused";
    case WorkerState::Done: return "done";
    case WorkerState::Failed: return "failed";
    }
    return "";
}

RenderWorker::RenderWorker(WorkerSetup setup)
    : setup_(std::move(setup)), backends_(setup_.make_backend, setup_.backends, setup_.first_backend),
      diagonal_(bounds_of(*setup_.scene).diagonal()), forced_(setup_.settings.forced_effects),
      full_width_(setup_.settings.width), full_height_(setup_.settings.height) {
    wishes_.limits = setup_.limits;
    wishes_.display = setup_.display;
    wishes_.backend = setup_.first_backend;
    status_.backend = setup_.first_backend;
    status_.scene = setup_.scene;
    run_set_ = runs_.current();
    status_.backends = backends_.choices();
    thread_ = std::thread([this] { run(); });
}

RenderWorker::~RenderWorker() {
    {
        const std::lock_guard lock(mutex_);
        wishes_.quit = true;
        stop_ = true;
    }
    wake_.notify_all();
    thread_.join();
}

std::uint64_t RenderWorker::submit(SessionEdit edit) {
    const std::lock_guard lock(mutex_);
    if (pass_may_be_cut_) stop_ = true;
    edits_.push(std::move(edit));
    wake_.notify_all();
    return ++wishes_.generation;
}

std::uint64_t RenderWorker::switch_backend(const std::string& name) {
    const std::lock_guard lock(mutex_);
    wishes_.backend = name;
    if (pass_may_be_cut_) stop_ = true;
    wake_.notify_all();
    return ++wishes_.generation;
}

std::string RenderWorker::wanted_backend() const {
    const std::lock_guard lock(mutex_);
    return wishes_.backend;
}

void RenderWorker::set_moving(bool moving) {
    const std::lock_guard lock(mutex_);
    wishes_.moving = moving;
    wake_.notify_all();
}

void RenderWorker::set_low_resolution_allowed(bool allowed) {
    const std::lock_guard lock(mutex_);
    wishes_.low_resolution = allowed;
}

void RenderWorker::set_paused(bool paused) {
    const std::lock_guard lock(mutex_);
    wishes_.paused = paused;
    wake_.notify_all();
}

void RenderWorker::step() {
    const std::lock_guard lock(mutex_);
    ++wishes_.steps;
    wake_.notify_all();
}

void RenderWorker::set_limits(SampleLimits limits) {
    const std::lock_guard lock(mutex_);
    wishes_.limits = limits;
    wake_.notify_all();
}

void RenderWorker::set_display(const DisplaySettings& display) {
    const std::lock_guard lock(mutex_);
    if (display == wishes_.display) return;
    wishes_.display = display;
    cut_for_a_frame();
}

void RenderWorker::set_values_wanted(bool wanted) {
    const std::lock_guard lock(mutex_);
    if (wanted == wishes_.values) return;
    wishes_.values = wanted;
    if (wanted) cut_for_a_frame();
}

/// A frame is wanted for what is there already. The mutex is held.
void RenderWorker::cut_for_a_frame() {
    if (pass_may_be_cut_ && status_.passes > 0) stop_ = true;
    wake_.notify_all();
}

void RenderWorker::set_reference(std::shared_ptr<const LiveReference> reference) {
    const std::lock_guard lock(mutex_);
    wishes_.reference = std::move(reference);
    wake_.notify_all();
}

void RenderWorker::set_turns(std::optional<TurnMethods> methods) {
    const std::lock_guard lock(mutex_);
    wishes_.turns = methods;
    if (methods) wishes_.trial.reset();
    if (pass_may_be_cut_) stop_ = true;
    wake_.notify_all();
}

void RenderWorker::set_cells_wanted(bool wanted) {
    const std::lock_guard lock(mutex_);
    wishes_.cells = wanted;
    wake_.notify_all();
}

void RenderWorker::request_pick(Vec2f image_point) {
    const std::lock_guard lock(mutex_);
    wishes_.pick = image_point;
    if (pass_may_be_cut_) stop_ = true;
    wake_.notify_all();
}

void RenderWorker::request_learned() {
    const std::lock_guard lock(mutex_);
    wishes_.learned = true;
    wake_.notify_all();
}

void RenderWorker::request_diagnostics() {
    const std::lock_guard lock(mutex_);
    wishes_.diagnostics = true;
    wake_.notify_all();
}

void RenderWorker::select_volume(std::int32_t volume) {
    const std::lock_guard lock(mutex_);
    wishes_.volume = volume;
    wake_.notify_all();
}

std::shared_ptr<const PublishedFrame> RenderWorker::latest() {
    const std::lock_guard lock(mutex_);
    frame_taken_ = true;
    return frame_;
}

WorkerStatus RenderWorker::status() const {
    const std::lock_guard lock(mutex_);
    return status_;
}

std::shared_ptr<const LiveRunSet> RenderWorker::runs() const {
    const std::lock_guard lock(mutex_);
    return run_set_;
}

std::vector<WorkerMessage> RenderWorker::take_messages() {
    const std::lock_guard lock(mutex_);
    return std::exchange(messages_, {});
}

std::optional<PickAnswer> RenderWorker::take_pick() {
    const std::lock_guard lock(mutex_);
    return std::exchange(pick_answer_, std::nullopt);
}

std::optional<LearnedAnswer> RenderWorker::take_learned() {
    const std::lock_guard lock(mutex_);
    return std::exchange(learned_answer_, std::nullopt);
}

std::optional<DiagnosticsAnswer> RenderWorker::take_diagnostics() {
    const std::lock_guard lock(mutex_);
    return std::exchange(diagnostics_answer_, std::nullopt);
}

std::exception_ptr RenderWorker::failure() const {
    const std::lock_guard lock(mutex_);
    return failure_;
}

void RenderWorker::report(WorkerMessage message) {
    const std::lock_guard lock(mutex_);
    messages_.push_back(std::move(message));
}

WorkerStatus RenderWorker::make_status() const {
    WorkerStatus status;
    status.passes = session_->passes();
    status.picture = divider_ == 1 && session_->film_origin().generation == picture_generation_ ? picture_ : 0;
    status.scene = session_->shared_scene();
    status.divider = divider_;
    status.effect_cost = effect_cost();
    status.generation = now_.generation;
    status.field = session_->field_status();
    status.seconds = work_seconds(session_->clocks());
    status.backend = backends_.current();
    status.backends = backends_.choices();
    if (turns_) {
        status.turns = turns_->status;
        status.passes = turns_->status.passes[0];
        status.seconds = turns_->status.seconds[0];
        status.field = turns_->field;
    }
    const bool precomputing = status.passes == 0 && status.field && status.field->precomputed_share < 1.0;
    if (failed_)
        status.state = WorkerState::Failed;
    else if (precomputing)
        status.state = WorkerState::Precomputing;
    else if (now_.paused)
        status.state = WorkerState::Paused;
    else if (status.passes > 0 && limit_reached())
        status.state = WorkerState::Done;
    else
        status.state = WorkerState::Rendering;
    return status;
}

void RenderWorker::update_status() {
    const WorkerStatus status = make_status();
    const std::lock_guard lock(mutex_);
    status_ = status;
}

}  // namespace pl
