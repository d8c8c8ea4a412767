#include "ui/worker/effect_trial.h"

namespace pl {

bool EffectTrial::matches(const std::optional<FeatureSet>& wanted) const {
    return wanted == (trial_ ? std::optional(trial_->forced) : std::nullopt);
}

void EffectTrial::settle(Session& session, const std::optional<FeatureSet>& wanted) {
    if (!wanted) {
        if (trial_) session.apply(EditEffects{forced_});
        trial_.reset();
    } else if (!matches(wanted)) {
        trial_ = Trial{.forced = *wanted};
    }
}

void EffectTrial::begin_pass(Session& session, FilmSlot slot, bool is_whole) {
    if (!trial_ || trial_->in_pass) return;
    if (!is_whole || trial_->cost.done()) {
        trial_->cost.drop_pair();
        session.apply(EditEffects{forced_});
        return;
    }
    const bool is_other = trial_->cost.next_is_other();
    session.apply(EditEffects{is_other ? trial_->forced : FeatureSet{}});
    trial_->kernels[is_other ? 1 : 0] = session.served_kernel(slot).name;
    trial_->seconds_before = session.clocks(slot).render;
    trial_->in_pass = true;
    trial_->is_disturbed = false;
}

void EffectTrial::end_pass(const Session& session, FilmSlot slot, const std::string& backend, Progress progress) {
    if (!trial_ || !trial_->in_pass) return;
    if (progress == Progress::Stopped) {
        trial_->is_disturbed = true;
        return;
    }
    trial_->in_pass = false;
    const std::pair film{session.film_origin(slot).number, backend};
    if (film != trial_->film) {
        trial_->film = film;
        trial_->cost = {};
    } else if (trial_->is_disturbed || progress != Progress::Rendered) {
        trial_->cost.drop_pair();
    } else {
        trial_->cost.add(session.clocks(slot).render - trial_->seconds_before);
    }
}

std::optional<EffectTrialCost> EffectTrial::cost() const {
    if (!trial_) return std::nullopt;
    return EffectTrialCost{.forced = trial_->forced,
                           .base_kernel = trial_->kernels[0],
                           .kernel = trial_->kernels[1],
                           .result = trial_->cost.result(),
                           .done = trial_->cost.done()};
}

}  // namespace pl
