#include "ui/model/render_link.h"

namespace pl::ui {

void Throughput::observe(const Snapshot& snapshot, const std::string& backend) {
    const std::uint64_t paths = snapshot.counters.paths;
    const bool is_other_film = snapshot.slot != slot_ || backend != backend_ || paths < paths_;
    if (is_other_film) {
        slot_ = snapshot.slot;
        backend_ = backend;
        paths_ = 0;
        seconds_ = 0.0;
    }
    const double elapsed = snapshot.clocks.render - seconds_;
    if (elapsed <= 0.0 || (elapsed < kIntervalSeconds && paths_ > 0)) return;
    mpaths_per_second_ = 1.0e-6 * static_cast<double>(paths - paths_) / elapsed;
    paths_ = paths;
    seconds_ = snapshot.clocks.render;
}

void RenderLink::update() {
    if (const std::exception_ptr failure = worker_.failure()) std::rethrow_exception(failure);
    take_frame();
    status_ = worker_.status();
}

void RenderLink::take_frame() {
    auto latest = worker_.latest();
    if (latest == latest_) return;
    latest_ = std::move(latest);
    const bool is_second = turns_ && latest_->side == 1;
    if (is_second) second_frame_ = latest_;
    if (!is_second || frame_ == nullptr) {  // the first picture is shown at once, whose it is
        frame_ = latest_;
        throughput_.observe(frame_->snapshot, frame_->backend.name);
    }
}

void RenderLink::hold(Hold reason, bool on) {
    holds_.set(static_cast<std::size_t>(reason), on);
    worker_.set_paused(holds_.any());
}

void RenderLink::begin_turns(const TurnSides& sides) {
    turns_ = sides;
    worker_.set_turns(turns_);
}

void RenderLink::end_turns(MethodId method) {
    if (!turns_) return;
    turns_.reset();
    second_frame_.reset();
    worker_.set_turns(std::nullopt);
    worker_.submit(method);
}

}  // namespace pl::ui
