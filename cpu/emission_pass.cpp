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

/// Returns the number of rays traced. With everything that it calls inlined, so that the kernels of other sets of features do not
/// change the instructions executed here.
template <FeatureSet F, class Trace>
[[gnu::flatten, gnu::noinline]] std::uint64_t trace_range(BatchedRays<F>& tracer, IndexRange range,
                                                          const Trace& trace) {
    std::uint64_t traced = 0;
    for (std::uint32_t i = range.begin; i < range.end; ++i) traced += trace(tracer, i);
    return traced;
}

template <FeatureSet F>
PassCounters run_emission_pass(const EmissionPass& pass) {
    const BvhIntersector intersector{pass.setup.scene};
    const SceneView& scene = pass.setup.scene;
    std::atomic<std::uint64_t> rays{0};
    const auto trace_all = [&](ChunkQueue& queue, const auto& trace) {
        run_on_threads(pass.setup.threads, [&](int) {
            BatchedRays<F> tracer(scene, pass.tracer, intersector);
            std::uint64_t traced = 0;
            for (IndexRange range = queue.claim(); !range.empty(); range = queue.claim())
                traced += trace_range(tracer, range, trace);
            rays.fetch_add(traced, std::memory_order_relaxed);
        });
    };
    if (pass.context.passes == kMarkingPass && pass.setup.paths.begin == 0 && pass.setup.paths.end > 0) {
        constexpr std::uint32_t kLightsPerClaim = 16;
        ChunkQueue lights(0, scene.lights.count, kLightsPerClaim);
        trace_all(lights, [&](BatchedRays<F>& tracer, std::uint32_t light) {
            return mark_lamp_borders<F>(pass.context, scene, tracer, pass.film, light);
        });
    }
    ChunkQueue pixels = pass.setup.chunks(pass.subset.count(pass.film.pixels.count));
    trace_all(pixels, [&](BatchedRays<F>& tracer, std::uint32_t number) {
        return refine_emission<F>(pass.context, scene, tracer, pass.film, pass.subset.pixel(number));
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
