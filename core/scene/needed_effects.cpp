#include "core/scene/needed_effects.h"

namespace pl {

FeatureSet needed_effects(const HostScene& scene) {
    FeatureSet set;
    if (!scene.triangle_normals.empty()) set = set.with(Feature::SmoothNormals);
    if (!is_black(scene.environment)) set = set.with(Feature::Environment);
    return set;
}

std::vector<std::string> effect_names(FeatureSet set) {
    std::vector<std::string> names;
    for (const Feature feature : kAllFeatures) {
        if (!set.has(feature)) continue;
        switch (feature) {
        case Feature::SmoothNormals: names.emplace_back("smooth-normals"); break;
        case Feature::Environment: names.emplace_back("environment"); break;
        case Feature::NextEventEstimation: names.emplace_back("next-event-estimation"); break;
        }
    }
    return names;
}

}  // namespace pl
