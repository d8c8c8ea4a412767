// All threading of this back end: threads claim work from a queue. Uses OpenMP; plain threads under the thread
// sanitizer, which does not see the synchronization of the OpenMP run-time library.
#pragma once

#include "core/base/parallel.h"

#ifndef PL_TSAN
#include <omp.h>
#endif

namespace pl {

/// Calls body(thread) with thread in [0, threads) on up to `threads` threads, joins them, and rethrows the first
/// exception. OpenMP may start fewer threads than requested, so threads claim work from a queue.
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

/// Calls body(range) for every chunk of the queue, in any order.
template <class Body>
void parallel_for(int threads, ChunkQueue& queue, Body&& body) {
    run_on_threads(threads, [&](int) {
        for (IndexRange range = queue.claim(); !range.empty(); range = queue.claim()) body(range);
    });
}

}  // namespace pl
