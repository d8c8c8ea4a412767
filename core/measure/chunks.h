// Sums over pixels by several threads, the same to the bit for any number of threads.
#pragma once

#include <vector>

#include "core/base/work_queue.h"

namespace pl {

/// Calls body(sums, range) for consecutive ranges of `chunk` numbers below `count`, each with Sums of its own, copied
/// from `empty`; returns them in the order of the ranges, so that adding them up does not depend on `threads`.
template <class Sums, class Body>
std::vector<Sums> sums_of_chunks(std::size_t count, std::uint32_t chunk, int threads, const Sums& empty,
                                 Body&& body) {
    std::vector<Sums> sums((count + chunk - 1) / chunk, empty);
    ChunkQueue queue(0, static_cast<std::uint32_t>(count), chunk);
    const auto work = [&](int) {
        for (IndexRange range = queue.claim(); !range.empty(); range = queue.claim())
            body(sums[range.begin / chunk], range);
    };
    run_on_plain_threads(threads > static_cast<int>(sums.size()) ? static_cast<int>(sums.size()) : threads, work);
    return sums;
}

}  // namespace pl
