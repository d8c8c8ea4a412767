// Number of paths per launch.
#pragma once

#include <algorithm>
#include <cstdint>

namespace pl::cuda {

/// Adapts the number of paths so that a launch takes about kTargetMilliseconds: long enough to make its overhead
/// negligible, short enough that a request to stop, polled between launches, takes effect without noticeable delay.
class LaunchSize {
public:
    static constexpr float kTargetMilliseconds = 6.0f;
    static constexpr std::uint32_t kFirst = 1u << 17;  ///< before the first measurement; fills a device
    static constexpr std::uint32_t kLeast = 1u << 12;
    static constexpr std::uint32_t kMost = 1u << 26;

    /// Number of paths of the next launch. Includes all of `remaining` if less than half a launch would be left over.
    std::uint32_t next(std::uint32_t remaining) const { return remaining < size_ + size_ / 2 ? remaining : size_; }

    /// Number of passes of `paths` paths each, at least one, that make up a launch.
    std::uint32_t passes(std::uint32_t paths, std::uint32_t most) const {
        return std::clamp(size_ / std::max(paths, 1u), 1u, std::max(most, 1u));
    }

    /// Adapts the size to a finished launch, by a factor of at most 4, so that an interruption of the device has no lasting effect.
    /// `evenness`: the mean number of segments of a thread over the largest. One thread with a long path may keep a launch waiting:
    /// its duration then says nothing about the throughput, and a smaller launch would last as long.
    void observe(std::uint32_t paths, float milliseconds, float evenness) {
        if (paths < size_ / 2) return;  // too few paths to fill the device: not representative
        const float scale = kTargetMilliseconds / std::max(milliseconds * evenness, 1.0e-3f);
        const float wanted = static_cast<float>(paths) * std::clamp(scale, 0.25f, 4.0f);
        size_ = static_cast<std::uint32_t>(std::clamp(wanted, static_cast<float>(kLeast), static_cast<float>(kMost)));
    }

private:
    std::uint32_t size_ = kFirst;
};

}  // namespace pl::cuda
