// The kernels of all passes except passes of pictures.
#include "cpu/passes/pass_kernels.h"

#include <span>

#include "cpu/rays/solid_hits.h"

namespace pl {
namespace {

template <FeatureSet F>
PassCounters run_probe_pass(const ProbePass& pass) {
    const ProbeWork<F> work{pass.field, pass.stratum};
    return run_paths<F>(pass.setup, pass.tracer, ProbeMethod{}, work);
}

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

/// Pixels whose rays are traced at once where each has one.
constexpr std::uint32_t kNotedPixels = 256;
static_assert(kNotedPixels >= kEmissionRays + 1);

/// Traces the rays of a pixel at once; a single one is faster alone. One object per thread.
template <FeatureSet F>
class BatchedRays {
public:
    BatchedRays(const SceneView& scene, const BatchTracer& tracer, const BvhIntersectorOf<F>& intersector)
        : scene_(scene), single_{scene, intersector}, solid_(scene, tracer, kNotedPixels), batch_(kNotedPixels) {}

    /// As SingleRays::trace().
    template <class RayOf, class Use>
    void trace(std::uint32_t count, const RayOf& ray_of, const Use& use) {
        if (count == 1) return single_.trace(count, ray_of, use);
        for (std::uint32_t i = 0; i < count; ++i) batch_.set_ray(i, ray_of(i));
        solid_.find_closest(batch_, count);
        for (std::uint32_t i = 0; i < count; ++i) use(i, batch_.ray(i), batch_.hit(i));
    }
    /// As SingleRays::trace_emission().
    template <class RayOf, class Add>
    void trace_emission(std::uint32_t count, const RayOf& ray_of, const Add& add) {
        trace(count, ray_of,
              [&](std::uint32_t i, const Ray& ray, const Hit& hit) { add(i, first_emission<F>(scene_, ray, hit)); });
    }
    /// Notes the emission of at most kNotedPixels pixels.
    void note(const EmissionContext& context, const FilmView& film, std::span<const std::uint32_t> pixels) {
        const auto count = static_cast<std::uint32_t>(pixels.size());
        for (std::uint32_t i = 0; i < count; ++i) batch_.set_ray(i, noting_ray<F>(context, pixels[i]));
        solid_.find_closest(batch_, count);
        for (std::uint32_t i = 0; i < count; ++i)
            note_emission<F>(scene_, batch_.ray(i), batch_.hit(i), film.pixels[pixels[i]].emission);
    }

private:
    const SceneView& scene_;
    SingleRays<F, BvhIntersectorOf<F>> single_;
    SolidHits<F, BatchTracer> solid_;
    RayBatch batch_;
};

/// refine_emission() of the pixels with these numbers in a pass that notes emission. Returns the number of rays traced.
template <FeatureSet F>
[[gnu::flatten, gnu::noinline]] std::uint64_t note_and_refine(BatchedRays<F>& tracer, IndexRange range,
                                                              const EmissionPass& pass) {
    std::uint64_t traced = 0;
    std::uint32_t noted[kNotedPixels];
    bool was_refined[kNotedPixels];
    for (std::uint32_t begin = range.begin; begin < range.end; begin += kNotedPixels) {
        const std::uint32_t count = std::min(kNotedPixels, range.end - begin);
        std::uint32_t fresh = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t pixel = begin + i;
            const EmissionSeen& seen = pass.film.pixels[pixel].emission;
            was_refined[i] = is_refined(seen);
            if (seen.varies == 0) noted[fresh++] = pixel;
        }
        tracer.note(pass.context, pass.film, {noted, fresh});
        traced += fresh;
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t pixel = begin + i;
            const EmissionWork work = emission_work(pass.context, pass.film.pixels[pixel].emission, was_refined[i]);
            refine_samples<F>(pass.context, tracer, pass.film, pixel, work);
            traced += work.all_rays();
        }
    }
    return traced;
}

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
    const BvhIntersectorOf<F> intersector{pass.setup.scene};
    const SceneView& scene = pass.setup.scene;
    std::atomic<std::uint64_t> total{0};
    const auto trace_all = [&](ChunkQueue& queue, const auto& trace) {
        run_on_threads(pass.setup.threads, [&](int) {
            BatchedRays<F> tracer(scene, pass.tracer, intersector);
            std::uint64_t traced = 0;
            for (IndexRange range = queue.claim(); !range.empty(); range = queue.claim())
                traced += trace(tracer, range);
            total.fetch_add(traced, std::memory_order_relaxed);
        });
    };
    if (pass.context.looks() == kMarkingLook && pass.setup.paths.begin == 0 && pass.setup.paths.end > 0) {
        constexpr std::uint32_t kLightsPerClaim = 16;
        ChunkQueue lights(0, scene.lights.count, kLightsPerClaim);
        trace_all(lights, [&](BatchedRays<F>& tracer, IndexRange range) {
            return trace_range(tracer, range, [&](BatchedRays<F>& rays, std::uint32_t light) {
                return mark_lamp_borders<F>(pass.context, scene, rays, pass.film, light);
            });
        });
    }
    ChunkQueue pixels = pass.setup.chunks(pass.film.pixels.count);
    trace_all(pixels, [&](BatchedRays<F>& tracer, IndexRange range) {
        if (notes_emission(pass.context.looks())) return note_and_refine<F>(tracer, range, pass);
        return trace_range(tracer, range, [&](BatchedRays<F>& rays, std::uint32_t pixel) {
            return refine_emission<F>(pass.context, scene, rays, pass.film, pixel);
        });
    });
    PassCounters counters;
    counters.path.emission_rays = total;
    return counters;
}

}  // namespace

constinit const PassKernels<ProbePass> kProbeKernels =
    make_kernel_row<PassCounters (*)(const ProbePass&), kProbeRange>(
        []<FeatureSet F>() { return run_probe_pass<F>; });

constinit const PassKernels<ViewPass> kViewKernels =
    make_kernel_row<PassCounters (*)(const ViewPass&), kViewRange>([]<FeatureSet F>() { return run_view_pass<F>; });

constinit const PassKernels<EmissionPass> kEmissionKernels =
    make_kernel_row<PassCounters (*)(const EmissionPass&), kEmissionRange>(
        []<FeatureSet F>() { return run_emission_pass<F>; });

}  // namespace pl
