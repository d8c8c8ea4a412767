// Loops whose chunks are run by several threads: code below the back ends, for work on large scenes.
#pragma once

#include "core/base/work_queue.h"

namespace pl {

/// Number of threads that run at once here.
inline int usable_threads() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

/// Calls body(range) for every chunk of the indices [0, count), in any order, on up to `threads` threads.
template <class Body>
void for_chunks(std::uint32_t count, std::uint32_t chunk, int threads, Body&& body) {
    const std::uint64_t chunks = (std::uint64_t{count} + chunk - 1) / chunk;
    ChunkQueue queue(0, count, chunk);
    run_on_plain_threads(static_cast<int>(std::min<std::uint64_t>(chunks, static_cast<std::uint64_t>(threads))),
                         [&](int) {
                             for (IndexRange range = queue.claim(); !range.empty(); range = queue.claim())
                                 body(range);
                         });
}

}  // namespace pl
