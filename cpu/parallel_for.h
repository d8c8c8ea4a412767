// All threading of this back end: a team of threads that claim work from a queue. OpenMP where it is there; plain
// threads under the thread sanitizer, which cannot see into the OpenMP run-time library.
#pragma once

#include "core/base/work_queue.h"

#ifndef PL_TSAN
#include <omp.h>
#endif

namespace pl {

/// Calls body(thread) on up to `threads` threads at once, with thread < threads, waits for all, and rethrows the first
/// exception. The number may be smaller than asked for, so work is claimed, never divided.
template <class Body>
void run_on_threads(int threads, Body&& body) {
#ifdef PL_TSAN
    run_on_plain_threads(threads, body);
#else
    FirstException exception;
#pragma omp parallel num_threads(threads)
    exception.guard([&] { body(omp_get_thread_num()); });
    exception.rethrow();
#endif
}

/// Threads that run at once on this machine.
inline int hardware_threads() {
#ifdef PL_TSAN
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
#else
    return omp_get_num_procs();
#endif
}

/// Calls body(range) for every chunk the queue hands out, in any order.
template <class Body>
void parallel_for(int threads, ChunkQueue& queue, Body&& body) {
    run_on_threads(threads, [&](int) {
        for (IndexRange range = queue.claim(); !range.empty(); range = queue.claim()) body(range);
    });
}

}  // namespace pl
