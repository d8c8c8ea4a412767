// Path tracing whose directions are even over the hemisphere: the yardstick of the thesis, and nothing to render with.
#pragma once

#include <vector>

#include "core/session/settings.h"

namespace pl::bench {

/// Picture of a scene of diffuse surfaces, `samples` paths per pixel, by the scalar loop of the kernel. Unbiased, so it converges
/// to what the methods converge to; how long it takes says nothing about them.
std::vector<Vec3f> render_uniform(const SceneDescription& scene, const RenderSettings& settings,
                                  std::uint32_t samples, int threads);

}  // namespace pl::bench
