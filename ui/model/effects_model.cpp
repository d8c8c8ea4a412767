#include "ui/model/effects_model.h"

#include "core/scene/needed_effects.h"
#include "core/session/session.h"

namespace pl::ui {

void EffectsModel::update(const PublishedFrame& frame) {
    Place place{.scene = frame.scene,
                .needed = needed_features(*frame.scene, frame.settings),
                .slot = frame.snapshot.slot,
                .learning = frame.settings.field.learning,
                .backend = frame.backend.name};
    if (place == place_) return;
    place_ = std::move(place);
    RenderSettings settings{.method = place_.slot.method, .view = place_.slot.view};
    settings.next_event = place_.needed.has(Feature::NextEventEstimation);
    settings.field.learning = place_.learning;
    kernel_ = served_kernel(place_.backend, place_.needed, settings).name;
    rows_.clear();
    for (const Feature feature : kAllFeatures) {
        const bool needed = place_.needed.has(feature);
        rows_.push_back({.name = effect_names(FeatureSet{}.with(feature)).front(),
                         .reason = needed ? reason_of(feature, *frame.description, frame.settings.camera) : ""});
    }
}

}  // namespace pl::ui
