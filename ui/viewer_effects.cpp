// The part of ViewerModel that is about effects: forcing them, and measuring what that costs.
#include "ui/viewer_model.h"

namespace pl {

void ViewerModel::set_forced_effects(FeatureSet forced) {
    if (forced == settings_.forced_effects) return;
    settings_.forced_effects = forced;
    worker_.submit(EditEffects{forced});
}

void ViewerModel::measure_effects(FeatureSet forced) {
    if (turns_) {
        say(LogLevel::Info, "two methods are in turns: end that first (X)");
        return;
    }
    if (status_.state != WorkerState::Rendering)
        say(LogLevel::Info, "passes are measured while the picture renders: let it go on");
    measuring_ = forced;
    worker_.measure_effects(forced);
}

void ViewerModel::stop_measuring_effects() {
    measuring_.reset();
    worker_.measure_effects(std::nullopt);
}

void ViewerModel::take_effects() {
    if (!frame_) return;
    const std::optional<EffectCost>& cost = status_.effect_cost;
    effects_.update(*frame_, cost);
    const bool is_done = cost && cost->forced == measuring_ && cost->done;
    if (measuring_ && (is_done || turns_)) stop_measuring_effects();  // turns take the render thread for themselves
}

}  // namespace pl
