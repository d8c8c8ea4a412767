// Launches of the kernels that trace paths: how many paths one takes, where unfinished ones wait, and their counts.
#pragma once

#include <algorithm>
#include <optional>

#include "core/session/backend.h"
#include "cuda/kernels/kernels.h"
#include "cuda/launch_size.h"
#include "cuda/runtime/device_array.h"
#include "cuda/runtime/launch.h"

namespace pl::cuda {

/// Tells the work of one request from the work of another: paths that wait belong to one request.
struct LaunchKey {
    int slot = -1;  ///< FilmSlot::index(); negative: a precomputation
    std::uint32_t sample = 0;
    pl::Stream stream = pl::Stream::Picture;  ///< of random numbers; pl::Stream, not the stream of the device

    friend bool operator==(const LaunchKey&, const LaunchKey&) = default;
};

/// A launch traces at most `most_segments` segments per thread, so that it ends soon whatever the length of the paths: a request
/// to stop, polled between launches, is honored, and the watchdog of a display does not fire. Paths under way then wait in device
/// memory for the next launch. Where no path can have so many segments none has to wait, and there is no memory for it.
class PathLauncher {
public:
    PathLauncher(const Stream& stream, std::uint32_t most_segments)
        : stream_(stream), most_segments_(most_segments) {}

    /// Traces the paths of a range, and puts them to their use. `trace(range)` queues the launch that traces the next ones, by
    /// launch_paths() or otherwise; `finish(range)` queues what follows when all of them have ended. Stopped, it returns the counts
    /// of the ranges that are finished. The paths under way wait for a call with the same key that begins where this one ended.
    template <class Trace, class Finish>
    PassCounters run(const LaunchKey& key, LaunchSize& size, PathRange paths, const StopFlag* stop,
                     const PathSettings& path, Trace&& trace, Finish&& finish);

    /// Queues a kernel for the range that run() gave to `trace`. `setup` holds scene and settings.
    template <class M, class Paths>
    void launch_paths(void (*kernel)(TraceSetup, M, Paths), TraceSetup setup, const M& method, const Paths& paths);

    /// From now on run() ends no launch before its last path, even if it is stopped.
    void settle_when_stopped() { settles_ = true; }

    /// Drops the paths that wait, if there are any: their scene or field is about to change.
    void forget() { launch_.reset(); }

    /// Incremented by the kernels that `trace` and `finish` queue.
    PassCounters* counters() const { return &counts_.data()->counters; }

private:
    /// Counted on the device by one launch.
    struct Counts {
        PassCounters counters;
        std::uint32_t longest = 0;  ///< segments of the thread that traced most
    };
    struct Launch {
        LaunchKey key;
        PathRange range;
        PassCounters counters{};
        std::uint64_t thread_segments = 0;  ///< if all threads had traced as many as the one with most
        float milliseconds = 0.0f;
        const void* kernel = nullptr;  ///< whose threads hold the paths that wait; null before the first launch
        std::uint32_t threads = 0;     ///< of its launch

        /// See LaunchSize::observe(); 1 if no paths were traced.
        float evenness() const {
            return thread_segments == 0
                       ? 1.0f
                       : static_cast<float>(counters.path.segments) / static_cast<float>(thread_segments);
        }
    };

    bool may_wait(const PathSettings& path) const;
    template <class Queue>
    void run_counted(Launch& current, Queue&& queue);
    void* stores(std::size_t bytes);
    Parking parking(std::uint32_t threads, std::size_t state_bytes, bool resumes);

    const Stream& stream_;
    Event launched_;
    Event finished_;
    int processors_ = processors_of_device();
    std::uint32_t most_segments_;
    bool settles_ = false;
    DeviceArray<std::uint32_t> claimed_{1};
    DeviceArray<Counts> counts_{1};
    PinnedMemory read_counts_{sizeof(Counts)};
    DeviceMemory stores_;
    DeviceMemory states_;
    DeviceArray<std::uint8_t> is_waiting_;
    std::optional<Launch> launch_;
};

template <class Trace, class Finish>
PassCounters PathLauncher::run(const LaunchKey& key, LaunchSize& size, PathRange paths, const StopFlag* stop,
                               const PathSettings& path, Trace&& trace, Finish&& finish) {
    PassCounters total;
    while (paths.first < paths.end) {
        const bool is_waiting = launch_ && launch_->key == key && launch_->range.first == paths.first;
        if (stop != nullptr && *stop && !(is_waiting && settles_)) break;
        if (!is_waiting)
            launch_ = Launch{.key = key, .range = {paths.first, paths.first + size.next(paths.end - paths.first)}};
        Launch& current = *launch_;
        const std::uint32_t count = current.range.end - current.range.first;
        if (may_wait(path)) {
            run_counted(current, [&] { trace(current.range); });
            if (current.counters.paths < count) continue;
            run_counted(current, [&] { finish(current.range); });
        } else {
            run_counted(current, [&] {
                trace(current.range);
                finish(current.range);
            });
        }
        size.observe(count, current.milliseconds, current.evenness());
        total += current.counters;
        paths.first = current.range.end;
        launch_.reset();
    }
    return total;
}

template <class Queue>
void PathLauncher::run_counted(Launch& current, Queue&& queue) {
    counts_.clear(stream_);
    launched_.record(stream_);
    queue();
    finished_.record(stream_);
    copy_to_host(read_counts_.data(), counts_.data(), sizeof(Counts), stream_);
    stream_.wait("tracing paths");
    const Counts& counts = *static_cast<const Counts*>(read_counts_.data());
    current.counters += counts.counters;
    current.thread_segments += std::uint64_t{counts.longest} * current.threads;
    current.milliseconds += finished_.milliseconds_since(launched_);
}

template <class M, class Paths>
void PathLauncher::launch_paths(void (*kernel)(TraceSetup, M, Paths), TraceSetup setup, const M& method,
                                const Paths& paths) {
    Launch& current = *launch_;
    // Another set of effects has another kernel, with another state: the paths are traced anew.
    const bool resumes = current.kernel == reinterpret_cast<const void*>(kernel);
    if (!resumes) {
        claimed_.clear(stream_);
        current.counters = {};
        current.thread_segments = 0;
    }
    setup.range = current.range;
    setup.claimed = claimed_.data();
    setup.counters = counters();
    setup.longest = &counts_.data()->longest;
    const LaunchShape shape = resident_threads(kernel, processors_, setup.range.end - setup.range.first);
    const std::uint32_t threads = current.threads = shape.blocks * shape.threads;
    setup.stores = stores(kNeedsStore<M> ? threads * sizeof(typename M::Store) : 1);
    // No set of effects has a larger state than all of them.
    if (may_wait(setup.path)) setup.parking = parking(threads, sizeof(PathState<kEveryFeature, M>), resumes);
    launch(kernel, shape, stream_, "trace_paths", setup, method, paths);
    current.kernel = reinterpret_cast<const void*>(kernel);
}

}  // namespace pl::cuda
