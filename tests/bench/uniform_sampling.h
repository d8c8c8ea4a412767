// Path tracing with directions uniform over the hemisphere: a yardstick, and no method to render with.
#pragma once

#include <vector>

#include "core/session/settings.h"

namespace pl::benchmarks {

/// Picture of a scene of diffuse surfaces, `samples` paths per pixel, by the scalar loop of the kernel. Unbiased, so it
/// converges to the picture of the methods; its time says nothing about theirs.
std::vector<Vec3f> render_uniform(const SceneDescription& scene, const RenderSettings& settings,
                                  std::uint32_t samples, int threads);

}  // namespace pl::benchmarks
