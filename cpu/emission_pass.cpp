#include "cpu/emission_pass.h"

namespace pl {
namespace {

template <FeatureSet F>
PassCounters run_emission_pass(const EmissionPass& pass) {
    const BvhIntersector intersector{pass.setup.scene};
    ChunkQueue queue = pass.setup.chunks(pass.film.pixels.count);
    std::atomic<std::uint64_t> rays{0};
    parallel_for(pass.setup.threads, queue, [&](IndexRange range) {
        std::uint64_t traced = 0;
        for (std::uint32_t pixel = range.begin; pixel < range.end; ++pixel)
            traced += refine_emission<F>(pass.context, pass.setup.scene, intersector, pass.film, pixel);
        rays.fetch_add(traced, std::memory_order_relaxed);
    });
    PassCounters counters;
    counters.path.emission_rays = rays;
    return counters;
}

}  // namespace

constinit const PassKernels<EmissionPass> kEmissionKernels =
    make_kernel_row<PassCounters (*)(const EmissionPass&), kEmissionRange>(
        []<FeatureSet F>() { return run_emission_pass<F>; });

}  // namespace pl
