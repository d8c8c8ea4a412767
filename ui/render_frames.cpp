// The part of RenderWorker that makes what the window gets: frames, cells, inspections, picks.
#include <chrono>

#include "core/base/error.h"
#include "ui/render_worker.h"

namespace pl {
namespace {

constexpr double kInspectionSeconds = 0.25;

double now_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Seconds between two pictures: the longer it has rendered, the less a pass changes.
double display_interval(double seconds) { return seconds < 2.0 ? 1.0 / 30.0 : (seconds < 10.0 ? 0.1 : 0.25); }

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

/// Brings method and view back, also when a back end fails in between.
class SlotKeeper {
public:
    explicit SlotKeeper(Session& session)
        : session_(session), method_(session.settings().method), view_(session.settings().view) {}
    ~SlotKeeper() {
        session_.apply(EditView{view_});
        session_.apply(EditMethod{method_});
    }
    SlotKeeper(const SlotKeeper&) = delete;
    SlotKeeper& operator=(const SlotKeeper&) = delete;

private:
    Session& session_;
    MethodId method_;
    View view_;
};

}  // namespace

void RenderWorker::render_cells() {
    const SlotKeeper keeper(*session_);
    session_->apply(EditMethod{MethodId::Default});
    session_->apply(EditView{View::Voronoi});
    const Progress progress = session_->advance(&stop_);
    if (progress != Progress::Rendered) return;
    cells_ = std::make_shared<CellImage>(make_cell_image(session_->show_film({}).frame));
    cells_pose_ = pose_;
    cells_refinement_ = session_->refinement();
    republish_ = true;
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
    now_.pick.reset();
}

void RenderWorker::answer_learned() {
    const SlotKeeper keeper(*session_);
    if (turns_) session_->apply(EditMethod{turns_->status.methods[0]});
    LearnedAnswer answer;
    try {
        answer.field = std::make_shared<const LearnedField>(session_->export_field());
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::Usage) throw;
        answer.reason = error.what();
    }
    const std::lock_guard lock(mutex_);
    learned_answer_ = std::move(answer);
    now_.learned = false;
}

void RenderWorker::answer_diagnostics() {
    DiagnosticsAnswer answer{.generation = now_.generation};
    try {
        if (divider_ != 1) throw Error(ErrorKind::Usage, "the camera moves: let the picture come to rest first");
        answer.source = diagnostics_input(*session_);
    } catch (const std::exception& error) {  // a lost device is found out by the next pass, too
        answer.reason = error.what();
    }
    const std::lock_guard lock(mutex_);
    diagnostics_answer_ = std::move(answer);
    now_.diagnostics = false;
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
        const SlotKeeper keeper(*session_);
        if (turns_) session_->apply(EditMethod{turns_->status.methods[0]});
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
    republish_ = false;
    settle_frame_wish();
    auto frame = std::make_shared<PublishedFrame>();
    ShownFilm shown = session_->show_film(now_.display);
    frame->picture = std::move(shown.frame);
    frame->range = std::move(shown.range);
    frame->display = now_.display;
    frame->snapshot = now_.values ? session_->snapshot() : session_->summary();
    frame->settings = session_->settings();
    frame->settings.width = full_width_;
    frame->settings.height = full_height_;
    frame->settings.forced_effects = forced_;
    frame->serial = frame_count_.load(std::memory_order_relaxed) + 1;
    frame->generation = now_.generation;
    frame->divider = divider_;
    frame->backend = session_->backend();
    frame->backend.name = backends_.current();
    frame->description = session_->shared_scene();
    frame->scene = session_->packed_scene();
    frame->diagonal = diagonal_;
    frame->cells = now_.cells && cells_are_current() ? cells_ : nullptr;
    frame->volume = inspection_;
    pose_unseen_ = false;
    published_at_ = now_seconds();
    published_passes_ = frame->snapshot.passes;
    const std::lock_guard lock(mutex_);
    frame_ = std::move(frame);
    frame_taken_ = false;
    frame_count_.fetch_add(1, std::memory_order_release);
}

}  // namespace pl
