#include "cpu/emission_pass.h"

#include "cpu/solid_hits.h"

namespace pl {
namespace {

/// Traces the rays of a pixel at once; a single one is faster alone. One object per thread.
template <FeatureSet F>
class BatchedRays {
public:
    BatchedRays(const SceneView& scene, const BatchTracer& tracer, const BvhIntersector& intersector)
        : single_{scene, intersector}, solid_(scene, tracer, kEmissionRays + 1), batch_(kEmissionRays + 1) {}

    /// As SingleRays::trace().
    template <class RayOf, class Use>
    void trace(std::uint32_t count, const RayOf& ray_of, const Use& use) {
        if (count == 1) return single_.trace(count, ray_of, use);
        for (std::uint32_t i = 0; i < count; ++i) batch_.set_ray(i, ray_of(i));
        solid_.find_closest(batch_, count);
        for (std::uint32_t i = 0; i < count; ++i) use(i, batch_.ray(i), batch_.hit(i));
    }

private:
    SingleRays<F, BvhIntersector> single_;
    SolidHits<F, BatchTracer> solid_;
    RayBatch batch_;
};

template <FeatureSet F>
PassCounters run_emission_pass(const EmissionPass& pass) {
    const BvhIntersector intersector{pass.setup.scene};
    ChunkQueue queue = pass.setup.chunks(pass.film.pixels.count);
    std::atomic<std::uint64_t> rays{0};
    run_on_threads(pass.setup.threads, [&](int) {
        BatchedRays<F> tracer(pass.setup.scene, pass.tracer, intersector);
        std::uint64_t traced = 0;
        for (IndexRange range = queue.claim(); !range.empty(); range = queue.claim())
            for (std::uint32_t pixel = range.begin; pixel < range.end; ++pixel)
                traced += refine_emission<F>(pass.context, pass.setup.scene, tracer, pass.film, pixel);
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
