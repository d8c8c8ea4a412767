// The source of a thread's paths: claimed chunks of path numbers, and the random numbers of each path's vertex 0.
#pragma once

#include "core/kernel/film/sample_variance.h"
#include "core/kernel/integrator/steps.h"
#include "cpu/base/number_batch.h"
#include "cpu/base/parallel_for.h"

namespace pl {

/// Paths per claim. A thread finishes every path that it claims.
inline constexpr std::uint32_t kPathChunk = 256;

/// The start of a path.
struct PathStart {
    std::uint32_t number = 0;
    Vec4f u{0.0f};          ///< of vertex 0
    Vec3f direction{0.0f};  ///< of the camera ray; only if StartKey::pinhole is set
};

/// The arguments of Rng::draw that all paths of a pass have in common at vertex 0.
struct StartKey {
    std::uint64_t seed = 0;
    Stream stream = Stream::Picture;
    Purpose purpose = Purpose::Pixel;
    std::uint32_t sample = 0;
    PixelSubset subset{};             ///< path numbers are numbers of its pixels
    const Camera* pinhole = nullptr;  ///< of which camera rays are made for all paths of a chunk
    PixelGrid grid{};
};

/// Claims chunks of the shared queue for one thread.
class PathSource {
public:
    PathSource(ChunkQueue& queue, const StartKey& key) : queue_(queue), key_(key) {}

    /// Finds the start of the next path. Returns false at the end of the queue.
    bool next(PathStart& start) {
        if (chunk_.empty() && !claim()) return false;
        const std::uint32_t index = chunk_.begin - first_;
        start.number = chunk_.begin++;
        start.u = numbers_[index / kGroupSize].get(index % kGroupSize);
        start.direction = directions_[index / kGroupSize].get(index % kGroupSize);
        return true;
    }

private:
    static constexpr std::uint32_t kGroups = group_count(kPathChunk);

    bool claim() {
        chunk_ = queue_.claim();
        if (chunk_.empty()) return false;
        first_ = chunk_.begin;
        for (std::uint32_t i = 0; i < kPathChunk; ++i) {
            counters_[i / kGroupSize].pixel[i % kGroupSize] = key_.subset.pixel(first_ + i);
            counters_[i / kGroupSize].sample[i % kGroupSize] = key_.sample;
        }
        kernels_.draw({key_.seed, key_.stream, key_.purpose}, counters_, numbers_, kGroups);
        if (key_.pinhole != nullptr)
            kernels_.find_camera_directions(*key_.pinhole, key_.grid, counters_, numbers_, directions_, kGroups);
        return true;
    }

    ChunkQueue& queue_;
    StartKey key_;
    LaneKernels kernels_ = best_lane_kernels();
    IndexRange chunk_;
    std::uint32_t first_ = 0;
    CounterGroup counters_[kGroups];
    NumberGroup numbers_[kGroups];
    VectorGroup directions_[kGroups];
};

}  // namespace pl
