#include "cpu/passes/pass_kernels.h"

namespace pl {
namespace {

template <FeatureSet F>
PassCounters run_view_pass(const ViewPass& pass) {
    const PassSetup& setup = pass.setup;
    const BvhIntersectorOf<F> intersector{setup.scene};
    const ViewContext context{.view = pass.view,
                              .shown = pass.shown,
                              .camera = pass.camera,
                              .settings = setup.path,
                              .grid = {pass.film.width, pass.film.height, pass.sample}};
    ChunkQueue queue = setup.chunks(pass.film.pixels.count);
    std::atomic<std::uint64_t> pixels{0};
    std::atomic<std::uint64_t> invalid{0};
    parallel_for(setup.threads, queue, [&](IndexRange range) {
        pixels.fetch_add(range.end - range.begin, std::memory_order_relaxed);
        for (std::uint32_t pixel = range.begin; pixel < range.end; ++pixel) {
            const Vec3f value = sample_view<F>(context, setup.scene, intersector, pixel);
            const bool valid = is_heat_map(pass.view) ? replace_sample(pass.film, pixel, value, pass.sample)
                                                      : accumulate(pass.film, pixel, value, pass.sample);
            if (!valid) invalid.fetch_add(1, std::memory_order_relaxed);
        }
    });
    PassCounters counters;
    counters.paths = pixels;
    counters.path.segments = pixels;
    counters.invalid_samples = invalid;
    return counters;
}

}  // namespace

constinit const PassKernels<ViewPass> kViewKernels =
    make_kernel_row<PassCounters (*)(const ViewPass&), kViewRange>([]<FeatureSet F>() { return run_view_pass<F>; });

}  // namespace pl
