// Loops whose chunks are run by several threads, and sums that are the same to the bit for any number of them.
#pragma once

#include "core/base/work_queue.h"

namespace pl {

/// Triangles or vertices that make a chunk worth a claim.
inline constexpr std::uint32_t kElementChunk = 8192;

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

/// Calls body(i) for the indices below `count`, by chunks of kElementChunk.
template <class Body>
void for_indices(std::uint32_t count, int threads, Body&& body) {
    for_chunks(count, kElementChunk, threads, [&](IndexRange range) {
        for (std::uint32_t i = range.begin; i < range.end; ++i) body(i);
    });
}

/// Calls body(sums, range) for consecutive ranges of `chunk` numbers below `count`, each with Sums of its own, copied
/// from `empty`; returns them in the order of the ranges, so that adding them up does not depend on `threads`.
template <class Sums, class Body>
std::vector<Sums> sums_of_chunks(std::size_t count, std::uint32_t chunk, int threads, const Sums& empty,
                                 Body&& body) {
    std::vector<Sums> sums((count + chunk - 1) / chunk, empty);
    for_chunks(static_cast<std::uint32_t>(count), chunk, threads,
               [&](IndexRange range) { body(sums[range.begin / chunk], range); });
    return sums;
}

}  // namespace pl
