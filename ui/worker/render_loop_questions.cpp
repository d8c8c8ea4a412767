// The part of RenderLoop that answers questions of the window, and follows the learned field for it.
#include <algorithm>

#include "ui/worker/answers.h"
#include "ui/worker/render_loop.h"

namespace pl::ui {

void RenderLoop::answer_questions() {
    const auto answer_numbers = [&](auto answer) {
        note_placement();  // the volumes may have been placed for it
        answer.placement = placement_;
        outbox_.answer(std::move(answer));
    };
    if (now_.once.pick) answer_numbers(answer_pick(*session_, *now_.once.pick));
    now_.once.pick.reset();
    if (!now_.once.places.empty()) answer_numbers(answer_volumes(*session_, now_.once.places));
    now_.once.places.clear();
    if (now_.once.learned) outbox_.answer(answer_learned(*session_, asked_method()));
    now_.once.learned = false;
    if (now_.once.diagnostics)
        outbox_.answer(size_.is_whole()
                           ? answer_diagnostics(*session_, asked_slot(), now_.generation)
                           : DiagnosticsAnswer{.reason = "the camera moves: let the picture come to rest first",
                                               .generation = now_.generation});
    now_.once.diagnostics = false;
    if (now_.once.paths)
        outbox_.answer(size_.is_whole()
                           ? answer_paths(*session_, asked_slot(), now_.generation)
                           : PathsAnswer{.reason = "the camera moves: let the picture come to rest first",
                                         .generation = now_.generation});
    now_.once.paths = false;
    if (now_.once.gain)
        outbox_.answer(size_.is_whole() ? answer_gain(*session_, asked_slot())
                                        : GainAnswer{.reason = "the camera moves"});
    now_.once.gain = false;
}

/// Refinement adds volumes behind the old ones, which keep their numbers.
void RenderLoop::note_placement() {
    const std::shared_ptr<const HostVolumes> volumes = session_->volumes();
    if (volumes == volumes_) return;
    const auto is_same_place = [](const SurfacePoint& a, const SurfacePoint& b) { return a.position == b.position; };
    const bool keeps_numbers =
        volumes && volumes_ && volumes->sites.size() >= volumes_->sites.size() &&
        std::equal(volumes_->sites.begin(), volumes_->sites.end(), volumes->sites.begin(), is_same_place);
    if (!keeps_numbers) ++placement_;
    volumes_ = volumes;
}

void RenderLoop::refresh_inspection() {
    if (passes() == 0) return;  // there may be no tables yet
    const bool is_other = now_.volume != selected_.shown() || wants_pins();
    bool is_fresh = selected_.refresh(*session_, asked_method(), now_.volume);
    pins_.resize(now_.pins.size());
    for (std::size_t i = 0; i < pins_.size(); ++i)
        is_fresh |= pins_[i].refresh(*session_, asked_method(), now_.pins[i]);
    if (is_fresh && (is_other || !wants_pass())) frames_.ask();
}

bool RenderLoop::wants_pins() const {
    if (pins_.size() != now_.pins.size()) return true;
    for (std::size_t i = 0; i < pins_.size(); ++i)
        if (pins_[i].wants(now_.pins[i])) return true;
    return false;
}

/// Key frames of the field, if the window requests them.
void RenderLoop::observe_field() {
    const bool is_other = now_.history_bytes != history_.limit();
    if (is_other) history_.set_limit(now_.history_bytes);
    const bool has_frame = history_.observe(*session_, asked_method());
    if (is_other || has_frame) outbox_.set_history(history_.history());
}

}  // namespace pl::ui
