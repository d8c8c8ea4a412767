#include "ui/worker/render_loop.h"

#include <sys/resource.h>

#include <algorithm>

#include "core/base/timer.h"

namespace pl::ui {
namespace {

/// Lowers the priority below that of the window, for machines with few cores. On Linux it applies to the calling
/// thread, and threads that the back end starts inherit it.
void yield_to_the_window() {
    constexpr int kNice = 3;
    (void)setpriority(PRIO_PROCESS, 0, kNice);
}

/// Whether the edit may change the cells that pixels show.
bool changes_cells(const WorkerEdit& edit) {
    return find_edit<EditCamera>(edit) || find_edit<EditScene>(edit) || find_edit<EditField>(edit) ||
           find_edit<EditLearned>(edit) || find_edit<EditMaterial>(edit);
}

}  // namespace

RenderLoop::RenderLoop(const WorkerSetup& setup, Inbox& inbox, Outbox& outbox)
    : inbox_(inbox), outbox_(outbox), backends_(setup.make_backend, setup.backends, setup.first_backend),
      shown_(slot_of(setup.settings)), size_(setup.settings.width, setup.settings.height),
      facts_(facts_of(*setup.scene)) {
    outbox_.set_runs(runs_.runs());
}

void RenderLoop::run(const WorkerSetup& setup) {
    yield_to_the_window();
    if (!start_session(setup)) return;
    if (setup.learned) apply_edits({EditLearned{setup.learned}});
    while (take_requests()) {
        if (!attempt([this] { work(); })) failed_ = true;
        update_status();
    }
    second_.reset();
    session_.reset();
}

bool RenderLoop::start_session(const WorkerSetup& setup) {
    const auto make = [&](std::shared_ptr<RenderBackend> backend) {
        return std::make_unique<Session>(std::move(backend), setup.scene, setup.settings, setup.load_seconds);
    };
    try {
        session_ = backends_.start(make, [this](const WorkerMessage& message) { outbox_.report(message); });
    } catch (...) {
        outbox_.fail(std::current_exception());
        return false;
    }
    settle_backend(setup.first_backend);
    return true;
}

/// Waits until there is something to do; false if the window has closed.
bool RenderLoop::take_requests() {
    std::vector<WorkerEdit> edits;
    const auto is_needed = [this] {
        if (has_work()) return true;
        update_status();
        return false;
    };
    if (!inbox_.take(now_, edits, is_needed)) return false;
    apply_edits(edits);
    if (now_.backend != backends_.current()) change_backend();
    settle_turns();
    if (!attempt([this] { settle_preview(wanted_preview()); })) failed_ = true;
    adopt_reference();
    inbox_.begin_pass(!is_coarse(), now_, backends_.current());
    return true;
}

bool RenderLoop::has_work() const {
    const bool is_other = now_.turns.has_value() != turns_.has_value() || now_.history_bytes != history_.limit() ||
                          now_.reference != runs_.reference() || now_.backend != backends_.current();
    if (now_.once.has_question() || is_other) return true;
    if (passes() > 0 && frames_.is_stale(now_)) return true;
    if (failed_) return false;
    if (preview_.now() != wanted_preview()) return true;
    const bool size_is_stale = !size_.is_whole() && !is_coarse();
    return size_is_stale || unmeasured_side() || wants_pass() || frames_.is_asked() || selected_.wants(now_.volume) ||
           wants_pins() || (now_.cells && !cells_.is_current(*session_));
}

/// Of a picture that rests, if its last passes were not measured; without turns both sides are the picture.
std::optional<std::size_t> RenderLoop::unmeasured_side() const {
    if (failed_ || is_coarse() || !size_.is_whole() || wants_pass() || preview_.now() != Preview::None)
        return std::nullopt;
    for (const std::size_t side : {0u, 1u})
        if (!runs_.is_up_to_date(session_of(side), slot_of_side(side))) return side;
    return std::nullopt;
}

/// Begins or ends turns as requested, and reads the time of both sides again: edits may have emptied their films.
void RenderLoop::settle_turns() {
    if (!now_.turns || (turns_ && turns_->status().sides != *now_.turns)) {
        turns_.reset();
        second_.reset();
    }
    if (!now_.turns) return;
    if (!turns_) turns_.emplace(*now_.turns);
    if (now_.turns->second && !second_ && !attempt([this] { make_second(); })) failed_ = true;
    for (const std::size_t side : {0u, 1u}) turns_->count(side, session_of(side), shown_.view);
}

/// The session beside the first one, with the same picture.
void RenderLoop::make_second() {
    const RenderSettings& own = session_->settings();
    RenderSettings settings = *now_.turns->second;
    settings.width = own.width;
    settings.height = own.height;
    settings.camera = own.camera;
    settings.seed = own.seed;
    settings.max_depth = own.max_depth;
    second_ = std::make_unique<Session>(*session_, backends_.make_another(), settings);
}

Preview RenderLoop::wanted_preview() const {
    if (!now_.preview || !is_coarse() || turns_ || failed_) return Preview::None;
    return MotionPreview::choose(*session_, shown_, preview_.now());
}

void RenderLoop::settle_preview(Preview wanted) {
    if (wanted == preview_.now()) return;
    if (preview_.apply(*session_, wanted)) cells_.invalidate();
    frames_.change_film();
}

void RenderLoop::adopt_reference() {
    if (now_.reference == runs_.reference()) return;
    attempt([this] { runs_.set_reference(now_.reference); });
    outbox_.set_runs(runs_.runs());
}

void RenderLoop::apply_edits(const std::vector<WorkerEdit>& edits) {
    for (const WorkerEdit& edit : edits) {
        failed_ = false;
        if (changes_cells(edit)) cells_.invalidate();
        if (find_edit<EditCamera>(edit)) size_.move_camera();
        selected_.invalidate();
        for (Inspection& pin : pins_) pin.invalidate();
        frames_.ask();
        attempt([&] {
            // Other edits belong to the session's own estimator.
            if (!find_edit<EditCamera>(edit)) {
                settle_preview(Preview::None);
                preview_.release();
            }
            apply(edit);
        });
    }
}

void RenderLoop::apply(const WorkerEdit& edit) {
    if (const auto* method = std::get_if<MethodId>(&edit)) shown_.method = *method;
    if (const auto* view = std::get_if<View>(&edit)) shown_.view = *view;
    if (const auto* change = std::get_if<SessionEdit>(&edit)) apply(*change);
}

/// May run twice, if a back end fails in between.
void RenderLoop::apply(const SessionEdit& edit) {
    if (const auto* size = std::get_if<EditSize>(&edit)) {
        size_.resize(size->width, size->height);  // work() gives it to the session
        return;
    }
    session_->apply(edit);
    if (second_) follow(edit);
    if (std::holds_alternative<EditScene>(edit) || std::holds_alternative<EditMaterial>(edit))
        facts_ = facts_of(session_->scene());
    if (const auto* learned = std::get_if<EditLearned>(&edit)) shown_.method = learned->field->method;
}

/// Both sides are emptied together. Without its fields the second one is made anew, on the edited scene; it keeps settings of its own.
void RenderLoop::follow(const SessionEdit& edit) {
    RenderSettings settings = second_->settings();
    const Invalidation clear = pl::take_over(edit, settings);
    if (clear.tables)
        second_.reset();
    else if (std::holds_alternative<EditCamera>(edit))
        second_->apply(edit);
    else if (clear.films)
        second_->apply(EditRestart{});
}

void RenderLoop::work() {
    if (size_.apply(*session_, is_coarse(), second_.get())) cells_.invalidate();
    const bool wants_volumes = selected_.wants(now_.volume) || wants_pins();
    if (passes() > 0 && (frames_.is_asked() || frames_.is_stale(now_) || wants_volumes) &&
        !holds_frames_back()) {  // a parked picture is shown at once
        frames_.settle(now_);
        refresh_inspection();
        publish();
    }
    answer_questions();
    if (turns_) take_turn();
    if (wants_pass()) render();
    if (const auto side = unmeasured_side(); side && runs_.observe(session_of(*side), slot_of_side(*side), true))
        outbox_.set_runs(runs_.runs());
    observe_field();
    if (*inbox_.stop_flag()) return;
    if (now_.cells && !cells_.is_current(*session_) && passes() > 0 && cells_.render(*session_, inbox_.stop_flag()))
        frames_.ask();
    refresh_inspection();
    if ((frames_.is_asked() || is_publishing_due()) && !holds_frames_back()) publish();
}

/// Changes sides when the other's turn has come, after a frame of the last one.
void RenderLoop::take_turn() {
    const std::size_t side = turns_->next(is_coarse(), now_);
    if (side == turns_->side()) return;
    if (passes() > 0 && !frames_.shows(passes())) publish();
    turns_->set_side(side);
    frames_.change_film();
    if (!wants_pass()) frames_.ask();  // turns end with this side, whose last pass came before them
}

void RenderLoop::render() {
    const Stopwatch watch;
    const bool is_whole = !is_coarse() && size_.is_whole();
    const std::uint32_t before = passes();
    const Progress progress = at_work().advance(slot(), inbox_.stop_flag(), is_whole ? most_passes() : 1);
    all_passes_ += passes() - before;
    if (progress == Progress::Rendered) {
        if (passes() == 1) frames_.ask();
        // In motion each pass is shown, and denoised.
        const RenderSettings& film = session_->settings();
        const double shown = now_.denoised && !turns_ ? denoised_.seconds_for(film.width, film.height) : 0.0;
        size_.observe(watch.seconds() / std::max(1u, passes() - before) + shown);
    }
    if (turns_) turns_->count(turns_->side(), at_work(), shown_.view);
    const bool is_last = now_.paused || now_.is_enough(passes(), seconds());
    const bool is_late =
        *inbox_.edit_flag();  // measuring takes as long as a frame, and the picture is about to change
    if (is_whole && !is_late && runs_.observe(at_work(), slot(), is_last)) outbox_.set_runs(runs_.runs());
    update_status();
    if (now_.once.steps > 0 || limit_reached() || now_.paused) frames_.ask();
}

/// Passes that may be rendered at once: one where each is looked at, or has to come soon.
std::uint32_t RenderLoop::most_passes() const {
    constexpr std::uint32_t kMostAtOnce = 16;
    const bool is_watched = now_.moving || now_.paused || now_.once.steps > 0 || turns_;
    if (is_watched || passes() == 0) return 1;
    if (now_.limits.spp == 0) return kMostAtOnce;
    return now_.limits.spp > passes() ? std::min(now_.limits.spp - passes(), kMostAtOnce) : 1;
}

bool RenderLoop::wants_pass() const {
    if (failed_) return false;
    // The picture follows the camera also while paused: one pass for every view of the scene.
    if (passes() == 0 || now_.once.steps > 0) return true;
    return !now_.paused && !limit_reached();
}

bool RenderLoop::limit_reached() const {
    // A coarser picture, or a preview, is replaced at rest; one that is neither goes on, with all samples of the motion.
    if (is_coarse() && !(size_.is_whole() && preview_.now() == Preview::None)) return false;
    if (turns_) return turns_->limit_reached(now_);
    return now_.is_enough(passes(), seconds());
}

bool RenderLoop::is_publishing_due() const {
    const double charged = turns_ ? turns_->status().seconds[0] : seconds();
    return frames_.is_due(passes(), now_.moving, charged) && outbox_.is_frame_taken();
}

/// At rest after a motion, while more passes follow.
bool RenderLoop::holds_frames_back() const {
    return !turns_ && wants_pass() && preview_.holds_back(passes(), seconds());
}

void RenderLoop::publish() {
    // Until the first pass is complete the window keeps its last picture.
    if (passes() == 0) return;
    frames_.settle(now_);
    frames_.begin();
    // In turns neither side is denoised: one alone would mislead.
    const bool denoises = now_.denoised && !turns_ && passes() < DenoisedPreview::kEnoughPasses;
    auto frame =
        std::make_shared<PublishedFrame>(frame_of_film(at_work(), slot(), now_.display, now_.values || denoises));
    frame->settings.width = size_.width();
    frame->settings.height = size_.height();
    frame->generation = now_.generation;
    frame->divider = size_.divider();
    frame->preview = preview_.now();
    frame->side = turns_ ? turns_->side() : 0;
    frame->backend.name = backends_.current();
    if (denoises && !denoised_.add_to(*frame, *session_, *inbox_.edit_flag())) {
        frames_.ask();  // the next frame takes the place of this one
        return;
    }
    frame->facts = facts_;
    frame->cells = now_.cells ? cells_.image(*session_) : nullptr;
    frame->volume = selected_.volume();
    for (const Inspection& pin : pins_)
        if (pin.volume()) frame->pins.push_back(pin.volume());
    size_.note_frame();
    preview_.note_frame();
    frames_.end(frame->snapshot.passes);
    outbox_.publish(std::move(frame));
}

WorkerState RenderLoop::state_of(const WorkerStatus& status) const {
    const bool precomputing = status.passes == 0 && status.field && status.field->precomputed_share < 1.0;
    if (failed_) return WorkerState::Failed;
    if (precomputing) return WorkerState::Precomputing;
    if (now_.paused) return WorkerState::Paused;
    return status.passes > 0 && limit_reached() ? WorkerState::Done : WorkerState::Rendering;
}

WorkerStatus RenderLoop::make_status() const {
    WorkerStatus status;
    status.passes = passes();
    status.all_passes = all_passes_;
    status.picture =
        size_.is_whole() && preview_.now() == Preview::None ? runs_.picture(at_work().film_origin(slot())) : 0;
    status.scene = session_->shared_scene();
    status.divider = size_.divider();
    status.generation = now_.generation;
    status.placement = placement_;
    status.field = session_->field_status(shown_.method);
    status.seconds = seconds();
    status.backend = backends_.current();
    status.backends = backends_.choices();
    if (turns_) {
        status.turns = turns_->status();
        status.passes = turns_->status().passes[0];
        status.seconds = turns_->status().seconds[0];
        status.field = turns_->field();
    }
    status.state = state_of(status);
    return status;
}

void RenderLoop::update_status() {
    note_placement();
    const WorkerStatus status = make_status();
    inbox_.note_film(status.passes > 0);
    outbox_.set_status(status);
}

}  // namespace pl::ui
