// Times of kernels and copies by events in their streams.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "cuda/runtime/check.h"
#include "tests/parity/launch_hooks.h"

namespace pl::parity {

/// Purpose of a kernel or copy within a pass.
enum class Work {
    Trace,    ///< paths, views and further camera rays
    Learn,    ///< updates of the field
    Publish,  ///< sums into the film, readings of it, frames
    Copy,     ///< copies and clears
    Other,    ///< kernels that kernels.h does not name
};
const char* name_of(Work work);

struct WorkTime {
    Work work = Work::Other;
    std::uint64_t count = 0;
    double milliseconds = 0.0;  ///< from the event before to the event after, the gap between launches included
    std::uint64_t bytes = 0;    ///< of copies and clears
};

/// Times the work that this process queues while the timer exists. One at a time.
class LaunchTimer {
public:
    LaunchTimer();
    ~LaunchTimer();
    LaunchTimer(const LaunchTimer&) = delete;
    LaunchTimer& operator=(const LaunchTimer&) = delete;

    /// By name of the kernel; copies and clears are "copy". Waits for the work queued so far. Throws Error(Unavailable) as CUDA does.
    std::map<std::string, WorkTime> times() const;

private:
    struct DestroyEvent {
        void operator()(cudaEvent_t event) const { (void)cudaEventDestroy(event); }
    };
    using Event = std::unique_ptr<std::remove_pointer_t<cudaEvent_t>, DestroyEvent>;
    struct TimedWork {
        QueuedWork work;
        Event start;
        Event end;
    };
    static Event record_event(cudaStream_t stream);
    std::vector<TimedWork> timed_;
};

}  // namespace pl::parity
