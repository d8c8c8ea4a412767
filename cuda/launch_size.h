// How many paths one launch traces.
#pragma once

#include <algorithm>
#include <cstdint>

namespace pl::cuda {

/// Sizes launches so that each lasts about kTargetMilliseconds: long enough that starting one costs nothing against
/// it, short enough that a wish to stop, looked at between launches, is honored at once.
class LaunchSize {
public:
    static constexpr float kTargetMilliseconds = 6.0f;
    static constexpr std::uint32_t kFirst = 1u << 17;  ///< before anything was measured; enough to fill a device
    static constexpr std::uint32_t kLeast = 1u << 12;
    static constexpr std::uint32_t kMost = 1u << 26;

    /// Paths of the next launch, of `remaining`. A rest of less than half a launch is taken along.
    std::uint32_t next(std::uint32_t remaining) const { return remaining < size_ + size_ / 2 ? remaining : size_; }

    /// Learns from a finished launch. One step changes the size by at most four times, so that an interruption of
    /// the device does not count for long.
    void observe(std::uint32_t paths, float milliseconds) {
        if (paths < size_ / 2) return;  // too few to fill the device: they say little about many
        const float scale = kTargetMilliseconds / std::max(milliseconds, 1.0e-3f);
        const float wanted = static_cast<float>(paths) * std::clamp(scale, 0.25f, 4.0f);
        size_ = static_cast<std::uint32_t>(std::clamp(wanted, static_cast<float>(kLeast), static_cast<float>(kMost)));
    }

private:
    std::uint32_t size_ = kFirst;
};

}  // namespace pl::cuda
