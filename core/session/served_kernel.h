// The compiled kernel that serves a scene and its settings.
#pragma once

#include <string>
#include <string_view>

#include "core/scene/scene_storage.h"
#include "core/session/settings.h"

namespace pl {

/// Effects that a scene, its camera and the settings need.
FeatureSet needed_features(const HostScene& scene, const RenderSettings& settings);

/// The kernel of a film's passes: it covers the needed effects and the forced ones.
struct ServedKernel {
    FeatureSet served{};    ///< needed and forced
    FeatureSet compiled{};  ///< effects of the kernel: the smallest compiled set of its range that covers them
    std::string name{};     ///< "cpu/reinforcement/next-event-estimation", for display
};
ServedKernel served_kernel(std::string_view backend, FeatureSet needed, const RenderSettings& settings);

}  // namespace pl
