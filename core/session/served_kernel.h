// Which of the compiled kernels serves a scene and its settings.
#pragma once

#include <string>
#include <string_view>

#include "core/scene/scene_storage.h"
#include "core/session/settings.h"

namespace pl {

/// Effects that a scene, its camera and the settings call for.
FeatureSet needed_features(const HostScene& scene, const RenderSettings& settings);

/// What passes run with, whose kernels cover the needed effects and the forced ones.
struct ServedKernel {
    FeatureSet served{};    ///< needed and forced
    FeatureSet compiled{};  ///< what the kernel can do: the smallest compiled set of its range that covers them
    std::string name{};     ///< "cpu/reinforcement/next-event-estimation", as shown to people
};
ServedKernel served_kernel(std::string_view backend, const HostScene& scene, const RenderSettings& settings);

}  // namespace pl
