// Sessions on the CUDA back end, run on the host.
#pragma once

#include "cuda/cuda_backend.h"
#include "tests/support/session/sessions.h"

namespace pl::test {

inline Session make_cuda_session(const SceneDescription& scene, const RenderSettings& settings,
                                 const CudaOptions& options = {}) {
    return Session(make_cuda_backend(options), std::make_shared<const SceneDescription>(scene), settings);
}

/// Launches so short that most paths have to wait for the next one.
inline constexpr CudaOptions kShortLaunches{.most_segments = 2};

}  // namespace pl::test
