#include "ui/render_worker.h"

#include <chrono>

#include <sys/resource.h>

#include "core/base/error.h"

namespace pl {
namespace {

constexpr double kInspectionSeconds = 0.25;

double now_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The window comes first where cores are few. On Linux this is about the calling thread, and threads that the back
/// end starts from it inherit it.
void yield_to_the_window() {
    constexpr int kNice = 3;
    (void)setpriority(PRIO_PROCESS, 0, kNice);
}

/// Seconds between two pictures: the longer it has rendered, the less a pass changes.
double display_interval(double seconds) { return seconds < 2.0 ? 1.0 / 30.0 : (seconds < 10.0 ? 0.1 : 0.25); }

/// Does the edit change which volume a pixel shows?
bool changes_pose(const SessionEdit& edit) {
    return std::holds_alternative<EditCamera>(edit) || std::holds_alternative<EditScene>(edit) ||
           std::holds_alternative<EditField>(edit);
}

/// What is known about a volume; only its number while nothing is learned.
VolumeInspection inspect(const Session& session, std::int32_t volume) {
    try {
        return session.inspect_volume(volume);
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::Usage) throw;
        VolumeInspection result;
        result.volume = volume;
        return result;
    }
}

}  // namespace

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
    : setup_(std::move(setup)), scene_(setup_.scene), diagonal_(bounds_of(*setup_.scene).diagonal()),
      full_width_(setup_.settings.width), full_height_(setup_.settings.height) {
    wishes_.limits = setup_.limits;
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

std::vector<WorkerMessage> RenderWorker::take_messages() {
    const std::lock_guard lock(mutex_);
    return std::exchange(messages_, {});
}

std::optional<PickAnswer> RenderWorker::take_pick() {
    const std::lock_guard lock(mutex_);
    return std::exchange(pick_answer_, std::nullopt);
}

std::exception_ptr RenderWorker::failure() const {
    const std::lock_guard lock(mutex_);
    return failure_;
}

void RenderWorker::report(bool is_error, const std::string& text) {
    const std::lock_guard lock(mutex_);
    messages_.push_back({is_error, text});
}

void RenderWorker::run() {
    yield_to_the_window();
    try {
        session_ =
            std::make_unique<Session>(setup_.make_backend(), setup_.scene, setup_.settings, setup_.load_seconds);
    } catch (...) {
        const std::lock_guard lock(mutex_);
        failure_ = std::current_exception();
        status_.state = WorkerState::Failed;
        return;
    }
    while (take_wishes()) {
        try {
            work();
        } catch (const std::exception& error) {
            failed_ = true;
            report(true, error.what());
        }
        update_status();
    }
    session_.reset();
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
        wishes_.steps = 0;
        stop_ = false;
    }
    apply_edits(std::move(edits));
    const std::lock_guard lock(mutex_);
    // A pass in motion is short and always finished: otherwise a hand that never rests would never see a picture.
    pass_may_be_cut_ = !coarse();
    if (pass_may_be_cut_ && !edits_.empty()) stop_ = true;  // came while nobody had decided
    return true;
}

bool RenderWorker::has_work() const {
    if (now_.pick) return true;
    if (failed_) return false;
    const bool size_is_stale = divider_ != 1 && !coarse();
    return size_is_stale || wants_pass() || republish_ || inspection_stale_ ||
           now_.volume != (inspection_ ? inspection_->volume : kNoVolume) || (now_.cells && cells_pose_ != pose_);
}

void RenderWorker::apply_edits(std::vector<SessionEdit> edits) {
    for (SessionEdit& edit : edits) {
        failed_ = false;
        try {
            if (changes_pose(edit)) ++pose_;
            pose_unseen_ = pose_unseen_ || std::holds_alternative<EditCamera>(edit);
            inspection_stale_ = true;
            republish_ = true;
            if (const auto* scene = std::get_if<EditScene>(&edit)) {
                scene_ = scene->scene;
                diagonal_ = bounds_of(*scene_).diagonal();
            }
            if (const auto* size = std::get_if<EditSize>(&edit)) {
                full_width_ = size->width;
                full_height_ = size->height;
                divider_ = 0;  // no size is right any more: work() applies the new one
            } else {
                session_->apply(edit);
            }
        } catch (const std::exception& error) {
            report(true, error.what());
        }
    }
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
    if (now_.pick) answer_pick(*now_.pick);
    if (wants_pass()) render();
    if (stop_) return;
    if (now_.cells && cells_pose_ != pose_ && session_->passes() > 0) render_cells();
    refresh_inspection();
    if (republish_ || publish_is_due()) publish();
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
    const SampleLimits& limits = now_.limits;
    if (limits.spp > 0 && session_->passes() >= limits.spp) return true;
    return limits.seconds > 0.0 && work_seconds(session_->clocks()) >= limits.seconds;
}

void RenderWorker::render() {
    const double start = now_seconds();
    const Progress progress = session_->advance(&stop_);
    if (progress == Progress::Rendered) {
        if (session_->passes() == 1) republish_ = true;
        motion_.observe(divider_, now_seconds() - start);
    }
    update_status();
    if (now_.steps > 0 || limit_reached() || now_.paused) republish_ = true;
}

void RenderWorker::render_cells() {
    const RenderSettings before = session_->settings();
    session_->apply(EditMethod{MethodId::Default});
    session_->apply(EditView{View::Voronoi});
    const Progress progress = session_->advance(&stop_);
    if (progress == Progress::Rendered) {
        cells_ = std::make_shared<CellImage>(make_cell_image(session_->snapshot(), cell_table_));
        cells_pose_ = pose_;
        republish_ = true;
    }
    session_->apply(EditView{before.view});
    session_->apply(EditMethod{before.method});
}

void RenderWorker::answer_pick(Vec2f image_point) {
    const RenderSettings& settings = session_->settings();
    PickAnswer answer;
    answer.point =
        session_->pick(image_point * Vec2f{static_cast<float>(settings.width), static_cast<float>(settings.height)});
    if (answer.point && answer.point->volume == kNoVolume)
        answer.point->volume = session_->find_volume_at(answer.point->position, answer.point->normal);
    const std::lock_guard lock(mutex_);
    pick_answer_ = answer;
}

void RenderWorker::refresh_inspection() {
    const std::int32_t shown = inspection_ ? inspection_->volume : kNoVolume;
    const bool aged = now_seconds() - inspected_at_ > kInspectionSeconds;
    if (now_.volume == shown && !inspection_stale_ && !(aged && now_.volume != kNoVolume)) return;
    if (session_->passes() == 0) return;  // there may be no tables yet
    inspection_stale_ = false;
    inspected_at_ = now_seconds();
    if (now_.volume == kNoVolume) {
        inspection_ = nullptr;
    } else {
        inspection_ = std::make_shared<VolumeInspection>(inspect(*session_, now_.volume));
    }
    if (now_.volume != shown || !wants_pass()) republish_ = true;
}

bool RenderWorker::publish_is_due() const {
    if (session_->passes() == 0 || session_->passes() == published_passes_) return false;
    bool taken = false;
    {
        const std::lock_guard lock(mutex_);
        taken = frame_taken_;
    }
    return taken && (now_.moving || now_seconds() - published_at_ >= display_interval(status_.seconds));
}

void RenderWorker::publish() {
    // Until the first pass is there the window keeps the picture it has.
    if (session_->passes() == 0) return;
    auto frame = std::make_shared<PublishedFrame>();
    frame->snapshot = session_->snapshot();
    frame->settings = session_->settings();
    frame->settings.width = full_width_;
    frame->settings.height = full_height_;
    frame->serial = frame_count_.load(std::memory_order_relaxed) + 1;
    frame->generation = now_.generation;
    frame->divider = divider_;
    frame->backend = session_->backend();
    frame->description = scene_;
    frame->scene = session_->packed_scene();
    frame->diagonal = diagonal_;
    frame->display_scale = display_scale(frame->snapshot);
    frame->cells = cells_pose_ == pose_ && now_.cells ? cells_ : nullptr;
    frame->volume = inspection_;
    republish_ = false;
    pose_unseen_ = false;
    published_at_ = now_seconds();
    published_passes_ = frame->snapshot.passes;
    const std::lock_guard lock(mutex_);
    frame_ = std::move(frame);
    frame_taken_ = false;
    frame_count_.fetch_add(1, std::memory_order_release);
}

WorkerStatus RenderWorker::make_status() const {
    WorkerStatus status;
    status.passes = session_->passes();
    status.divider = divider_;
    status.generation = now_.generation;
    status.field = session_->field_status();
    status.seconds = work_seconds(session_->clocks());
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
