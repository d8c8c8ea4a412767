// The effects of the picture and trials of their cost: passes of two kernels in turns into the running picture, which
// does not depend on the kernel.
#pragma once

#include <optional>

#include "ui/model/effects_model.h"
#include "ui/model/messages.h"
#include "ui/model/render_link.h"

namespace pl {

class EffectTrials {
public:
    EffectTrials(RenderLink& link, Messages& messages) : link_(link), messages_(messages) {}

    /// Takes the newest costs; once per frame of the window.
    void update();

    /// Which effects are needed and why, and their measured costs.
    const EffectsModel& table() const { return table_; }
    /// Effects of the trial under way.
    const std::optional<FeatureSet>& measuring() const { return measuring_; }
    /// Measures the time per pass with these effects forced.
    void measure(FeatureSet forced);
    void stop();

private:
    RenderLink& link_;
    Messages& messages_;
    EffectsModel table_;
    std::optional<FeatureSet> measuring_;
};

}  // namespace pl
