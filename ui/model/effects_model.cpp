#include "ui/model/effects_model.h"

#include <algorithm>

#include "core/scene/effect_reasons.h"
#include "core/scene/needed_effects.h"
#include "core/session/session.h"

namespace pl {

void EffectsModel::update(const PublishedFrame& frame, const std::optional<EffectTrialCost>& measured) {
    Place place{.scene = frame.scene,
                .needed = needed_features(*frame.scene, frame.settings),
                .slot = frame.snapshot.slot,
                .learning = frame.settings.field.learning,
                .backend = frame.backend.name,
                .width = frame.settings.width,
                .height = frame.settings.height};
    if (!(place == place_)) {
        place_ = std::move(place);
        kernel_ = kernel_with({});
        rows_.clear();
        costs_.clear();
        for (const Feature feature : kAllFeatures) {
            const FeatureSet alone = FeatureSet{}.with(feature);
            const bool needed = place_.needed.has(feature);
            rows_.push_back({.feature = feature,
                             .name = effect_names(alone).front(),
                             .reason = needed ? reason_of(feature, *frame.description, frame.settings.camera) : "",
                             .kernel = kernel_with(alone)});
        }
    }
    if (!measured || measured->base_kernel != kernel_ || measured->result.pairs == 0) return;
    std::erase_if(costs_, [&](const EffectTrialCost& cost) { return cost.kernel == measured->kernel; });
    costs_.push_back(*measured);
}

std::string EffectsModel::kernel_with(FeatureSet forced) const {
    RenderSettings settings{.method = place_.slot.method, .view = place_.slot.view, .forced_effects = forced};
    settings.next_event = place_.needed.has(Feature::NextEventEstimation);
    settings.field.learning = place_.learning;
    return served_kernel(place_.backend, place_.needed, settings).name;
}

const EffectTrialCost* EffectsModel::cost_of(FeatureSet forced) const {
    const auto cost = std::ranges::find(costs_, kernel_with(forced), &EffectTrialCost::kernel);
    return cost != costs_.end() ? &*cost : nullptr;
}

}  // namespace pl
