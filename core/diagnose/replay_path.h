// One path of a past pass, traced again: scene, camera, pixel and sample number decide a path, so that all its
// vertices are the same to the bit, unless the field it samples from has been updated since.
#pragma once

#include <cstdint>

#include "core/session/pass_replay.h"

namespace pl::diagnose {

/// Defects on one path.
struct PathDefects {
    std::uint32_t escapes = 0;
    std::uint32_t lookup_misses = 0;
    std::uint32_t clamped_samples = 0;  ///< 0 unless PassReplay::repeats_training
};

/// Runs the kernel's own loop, trace_path(), on the CPU. `field` is the view of PassReplay::field; empty for methods without
/// one.
PathDefects replay_path(const PassReplay& passes, const AnyFieldView& field, std::uint32_t pixel,
                        std::uint32_t sample);

}  // namespace pl::diagnose
