#include "ui/model/effect_trials.h"

namespace pl {

void EffectTrials::measure(FeatureSet forced) {
    if (link_.turns()) {
        messages_.say(MessageLevel::Info, "two methods are rendering in turns: end that first (X)");
        return;
    }
    if (link_.status().state != WorkerState::Rendering)
        messages_.say(MessageLevel::Info, "passes are timed while the picture renders: let it continue");
    measuring_ = forced;
    link_.worker().measure_effects(forced);
}

void EffectTrials::stop() {
    measuring_.reset();
    link_.worker().measure_effects(std::nullopt);
}

void EffectTrials::update() {
    if (!link_.frame()) return;
    const std::optional<EffectTrialCost>& cost = link_.status().effect_cost;
    table_.update(*link_.frame(), cost);
    const bool is_done = cost && cost->forced == measuring_ && cost->done;
    if (measuring_ && (is_done || link_.turns())) stop();  // turns and trials exclude each other
}

}  // namespace pl
