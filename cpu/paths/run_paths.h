// A pass on the CPU: threads claim chunks of its paths, and each traces them in a batch of its own.
#pragma once

#include <vector>

#include "cpu/paths/path_batch.h"

namespace pl {

/// Traces the paths of `work` on setup.threads threads.
template <FeatureSet F, Method M, BatchIntersector I, PathWork<F, M> W>
PassCounters run_paths(const PassSetup& setup, const I& intersector, const M& method, const W& work) {
    ChunkQueue queue = setup.chunks(work.count());
    SharedByThreads<M> shared(method);
    std::vector<PassCounters> counters(static_cast<std::size_t>(setup.threads));
    run_on_threads(setup.threads, [&](int thread) {
        PathSource source(queue, work.start_key(setup.path));
        PathBatch<F, M, I, W> batch(setup, intersector, method, work, shared);
        counters[static_cast<std::size_t>(thread)] = batch.run(source);
    });
    PassCounters total;
    for (const PassCounters& one : counters) total += one;
    return total;
}

}  // namespace pl
