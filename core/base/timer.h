// Wall-clock stopwatch on the steady clock.
#pragma once

#include <chrono>
#include <ctime>

namespace pl {

class Stopwatch {
public:
    Stopwatch() : start_(std::chrono::steady_clock::now()) {}
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_;
};

// Stopwatch of the calling thread's own processor time: work on a busy machine takes as much of it as on an idle one.

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
