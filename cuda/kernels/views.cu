#include "cuda/kernels/kernels.h"
#include "cuda/kernels/lane.cuh"
#include "cuda/kernels/scattered_pixels.h"
#include "cuda/runtime/launch.h"

namespace pl::cuda {
namespace {

template <std::uint32_t kFeatureBits>
__global__ void __launch_bounds__(kThreadsPerBlock) show_view(const __grid_constant__ ViewSetup setup) {
    const BvhIntersectorOf<FeatureSet{kFeatureBits}> intersector{setup.scene};
    const std::uint32_t i = thread_number();
    PassCounters counters;
    if (i < setup.radiance.count) {
        const Vec3f value =
            sample_view<FeatureSet{kFeatureBits}>(setup.context, setup.scene, intersector, setup.first + i);
        setup.radiance[i] = value;
        counters.paths = 1;
        counters.path.segments = 1;
        counters.invalid_samples = is_valid_radiance(value) ? 0 : 1;
    }
    add_up(*setup.counters, counters);
}

/// Traces the rays of one pixel by all lanes of a warp; each lane adds up the emission that all have seen, in the order of the rays.
template <FeatureSet F>
struct WarpRays {
    const SceneView& scene;
    const BvhIntersectorOf<F>& intersector;

    /// As SingleRays::trace_emission(); to be called by all lanes alike.
    template <class RayOf, class Add>
    __device__ void trace_emission(std::uint32_t count, const RayOf& ray_of, const Add& add) const {
        for (std::uint32_t first = 0; first < count; first += kWarpLanes) {
            const std::uint32_t own = first + lane_number();
            Vec3f seen{0.0f};
            if (own < count) {
                const Ray ray = ray_of(own);
                seen = first_emission<F>(scene, ray, closest_solid_hit<F>(scene, intersector, ray));
            }
            for (std::uint32_t lane = 0; lane < min_of(count - first, kWarpLanes); ++lane)
                add(first + lane, of_lane(seen, lane));
        }
    }
};

/// Few pixels have borders, each with many rays: a warp does the work of its pixels one after the other, by all lanes.
template <std::uint32_t kFeatureBits>
__global__ void __launch_bounds__(kThreadsPerBlock) refine_film(const __grid_constant__ EmissionSetup setup) {
    constexpr FeatureSet kFeatures{kFeatureBits};
    const BvhIntersectorOf<kFeatures> intersector{setup.scene};
    const std::uint32_t count = setup.range.end - setup.range.first;
    const std::uint32_t number = scattered_number(thread_number(), kWarpLanes, count);
    SingleRays<kFeatures, BvhIntersectorOf<kFeatures>> own_rays{setup.scene, intersector};
    PassCounters counters;
    std::uint32_t pixel = 0;
    EmissionWork work;
    if (number < count) {
        pixel = setup.range.first + number;
        work = find_emission_work<kFeatures>(setup.context, setup.scene, own_rays, setup.film, pixel,
                                             counters.path.emission_rays);
        counters.path.emission_rays += work.all_rays();
    }
    WarpRays<kFeatures> rays{setup.scene, intersector};
    for (std::uint32_t waiting = lanes_where(work.samples > 0); waiting != 0; waiting &= waiting - 1) {
        const std::uint32_t lane = lowest_bit(waiting);
        const std::uint32_t served = of_lane(pixel, lane);
        refine_samples<kFeatures>(setup.context, rays, served,
                                  {of_lane(work.samples, lane), of_lane(work.rays, lane)},
                                  [&](std::uint32_t sample, std::uint32_t weight, Vec3f correction) {
                                      if (lane_number() == lane)
                                          correct_sample(setup.film, served, correction, sample, weight);
                                  });
    }
    add_up(*setup.counters, counters);
}

template <std::uint32_t kFeatureBits>
__global__ void __launch_bounds__(kThreadsPerBlock) mark_borders(const __grid_constant__ EmissionSetup setup) {
    constexpr FeatureSet kFeatures{kFeatureBits};
    const BvhIntersectorOf<kFeatures> intersector{setup.scene};
    const std::uint32_t light = thread_number();
    SingleRays<kFeatures, BvhIntersectorOf<kFeatures>> rays{setup.scene, intersector};
    PassCounters counters;
    if (light < setup.scene.lights.count)
        counters.path.emission_rays =
            mark_lamp_borders<kFeatures>(setup.context, setup.scene, rays, setup.film, light);
    add_up(*setup.counters, counters);
}

__global__ void __launch_bounds__(kThreadsPerBlock)
    volume_values(const __grid_constant__ TableUpdateView field, View view, Span<float> values) {
    const std::uint32_t volume = thread_number();
    if (volume < values.count) values[volume] = volume_value(TableVolumeSummary{field}, volume, view);
}

}  // namespace

constinit const KernelRow<ViewKernel> kViewKernels =
    make_kernel_row<ViewKernel, kViewRange>([]<FeatureSet F>() { return show_view<F.bits>; });
constinit const KernelRow<EmissionKernel> kEmissionKernels =
    make_kernel_row<EmissionKernel, kEmissionRange>([]<FeatureSet F>() { return refine_film<F.bits>; });
constinit const KernelRow<EmissionKernel> kBorderKernels =
    make_kernel_row<EmissionKernel, kEmissionRange>([]<FeatureSet F>() { return mark_borders<F.bits>; });
constinit const VolumeValueKernel kVolumeValues = volume_values;

}  // namespace pl::cuda
