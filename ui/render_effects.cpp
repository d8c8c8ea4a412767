// The part of RenderWorker that measures what being able to do more effects costs: passes of the picture under way are made
// by both kernels in turns. They give the same bits, so the picture does not know of it.
#include "ui/render_worker.h"

namespace pl {

void RenderWorker::measure_effects(std::optional<FeatureSet> forced) {
    const std::lock_guard lock(mutex_);
    wishes_.trial = wishes_.turns ? std::nullopt : forced;
    wake_.notify_all();
}

/// Begins or ends a trial as the window wishes.
void RenderWorker::settle_trial() {
    if (!now_.trial) {
        if (trial_) session_->apply(EditEffects{forced_});
        trial_.reset();
    } else if (!trial_ || trial_->forced != *now_.trial) {
        trial_.emplace();
        trial_->forced = *now_.trial;
    }
}

/// Before a pass, or a part of one. Only whole pictures are measured.
void RenderWorker::begin_trial_pass() {
    if (!trial_ || trial_->in_pass) return;
    const bool measures = !coarse() && divider_ == 1 && !trial_->cost.done();
    if (!measures) {
        trial_->cost.drop_pair();
        session_->apply(EditEffects{forced_});
        return;
    }
    session_->apply(EditEffects{trial_->cost.next_is_other() ? trial_->forced : FeatureSet{}});
    trial_->kernels[trial_->cost.next_is_other() ? 1 : 0] = session_->served_kernel().name;
    trial_->seconds_before = session_->clocks().render;
    trial_->in_pass = true;
    trial_->disturbed = false;
}

/// Passes that were interrupted, and those of another picture than the one before, do not count.
void RenderWorker::end_trial_pass(Progress progress) {
    if (!trial_ || !trial_->in_pass) return;
    if (progress == Progress::Stopped) {
        trial_->disturbed = true;
        return;
    }
    trial_->in_pass = false;
    const std::pair film{session_->film_origin().number, backends_.current()};
    if (film != trial_->film) {
        trial_->film = film;
        trial_->cost = {};
    } else if (trial_->disturbed || progress != Progress::Rendered) {
        trial_->cost.drop_pair();
    } else {
        trial_->cost.add(session_->clocks().render - trial_->seconds_before);
    }
}

std::optional<EffectCost> RenderWorker::effect_cost() const {
    if (!trial_) return std::nullopt;
    return EffectCost{.forced = trial_->forced,
                      .base_kernel = trial_->kernels[0],
                      .kernel = trial_->kernels[1],
                      .result = trial_->cost.result(),
                      .done = trial_->cost.done()};
}

}  // namespace pl
