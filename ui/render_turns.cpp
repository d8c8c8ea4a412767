// The part of RenderWorker that lets two methods render in turns of equal charged time.
#include "ui/render_worker.h"

namespace pl {

/// Begins or ends turns as the window wishes, and looks again at what each method was charged: edits may have emptied
/// their pictures.
void RenderWorker::settle_turns() {
    if (!now_.turns) {
        turns_.reset();
        return;
    }
    if (!turns_ || turns_->status.methods != *now_.turns) {
        turns_.emplace();
        turns_->status.methods = *now_.turns;
    }
    read_turns();
}

/// Looks at both methods, and ends at that of the present turn.
void RenderWorker::read_turns() {
    for (const std::size_t side : {1 - turns_->side, turns_->side}) {
        session_->apply(EditMethod{turns_->status.methods[side]});
        count_turn(side);
    }
}

/// Once a method is at a limit: the other one until it has had the same time and a pass, and then that one. Empty before.
std::optional<std::size_t> RenderWorker::side_at_limit() const {
    const TurnsStatus& status = turns_->status;
    for (const std::size_t side : {0u, 1u}) {
        if (!is_enough(status.passes[side], status.seconds[side])) continue;
        const std::size_t other = 1 - side;
        const bool has_had_its_time = status.seconds[other] >= status.seconds[side] && status.passes[other] > 0;
        const bool is_behind = !has_had_its_time && !is_enough(status.passes[other], status.seconds[other]);
        return is_behind ? other : side;
    }
    return std::nullopt;
}

/// Changes sides when the other's turn has come. What the last one rendered is shown before.
void RenderWorker::take_turn() {
    // While the camera moves only one picture is seen: it follows as quickly as without turns.
    const auto limited = side_at_limit();
    const std::size_t side = coarse() ? 0 : (limited ? *limited : turns_->order.next(turns_->status.seconds));
    turns_->status.catching_up = turns_->order.catching_up();
    if (side == turns_->side) return;
    if (session_->passes() > 0 && session_->passes() != published_passes_) publish();
    turns_->side = side;
    session_->apply(EditMethod{turns_->status.methods[side]});
    published_passes_ = 0;
}

void RenderWorker::count_turn(std::size_t side) {
    turns_->status.passes[side] = session_->passes();
    turns_->status.seconds[side] = work_seconds(session_->clocks());
    if (side == 0) turns_->field = session_->field_status();
}

}  // namespace pl
