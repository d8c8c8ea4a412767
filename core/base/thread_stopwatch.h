// Stopwatch of the calling thread's own processor time: work on a busy machine takes as much of it as on an idle one.
#pragma once

#include <ctime>

namespace pl {

/// Made and read by the same thread.
class ThreadStopwatch {
public:
    ThreadStopwatch() : start_(now()) {}
    double seconds() const { return now() - start_; }

private:
    static double now() {
        timespec time{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return static_cast<double>(time.tv_sec) + 1.0e-9 * static_cast<double>(time.tv_nsec);
    }

    double start_;
};

}  // namespace pl
