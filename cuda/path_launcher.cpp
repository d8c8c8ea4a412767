#include "cuda/path_launcher.h"

namespace pl::cuda {

/// Whether a path may have more segments than a launch traces.
bool PathLauncher::may_wait(const PathSettings& path) const { return path.max_depth > most_segments_; }

void* PathLauncher::stores(std::size_t bytes) {
    if (stores_.bytes() < bytes) stores_ = DeviceMemory(bytes);
    return stores_.data();
}

Parking PathLauncher::parking(std::uint32_t threads, std::size_t state_bytes, bool resumes) {
    if (states_.bytes() < threads * state_bytes) states_ = DeviceMemory(threads * state_bytes);
    if (is_waiting_.size() < threads) is_waiting_ = DeviceArray<std::uint8_t>(threads);
    return {.states = states_.data(),
            .is_waiting = is_waiting_.data(),
            .most_segments = most_segments_,
            .resumes = resumes ? 1u : 0u};
}

}  // namespace pl::cuda
