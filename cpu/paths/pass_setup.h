// The arguments of a pass, and its paths.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>

#include "core/kernel/integrator/path.h"
#include "core/session/backend.h"
#include "cpu/paths/light_table.h"
#include "cpu/paths/path_source.h"

namespace pl {

/// Arguments common to all passes.
struct PassSetup {
    SceneView scene;
    const LightTable* lights = nullptr;  ///< of the scene; without them lights are sampled path by path
    PathSettings path;
    IndexRange paths{0, kToTheLast};  ///< numbers of the paths to trace, clamped to those of the pass
    const StopFlag* stop = nullptr;
    int threads = 1;
    std::uint32_t batch_paths = 1024;

    /// Chunks of the paths to trace; the pass has `count` paths.
    ChunkQueue chunks(std::uint32_t count) const {
        return ChunkQueue(paths.begin, std::min(paths.end, count), kPathChunk, stop);
    }
};

/// A set of paths numbered from 0: creates their first rays and stores their radiance. start_key() decides their random
/// numbers at vertex 0; finish() returns true if the sample is valid; prefetch() asks for the memory that finish() needs, for
/// PathState::pixel of the path.
template <class W, FeatureSet F, class M>
concept PathWork = requires(const W& work, const PathSettings& path, const PathStart& start,
                            const PathState<F, M>& state, PassCounters& counters) {
    { work.count() } -> std::same_as<std::uint32_t>;
    { work.start_key(path) } -> std::same_as<StartKey>;
    { work.begin(start) } -> std::same_as<PathState<F, M>>;
    { work.prefetch(start.number) } -> std::same_as<void>;
    { work.finish(state, counters) } -> std::same_as<bool>;
};

}  // namespace pl
