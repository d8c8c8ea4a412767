#include "cuda/kernels/kernels.h"
#include "cuda/kernels/lane.cuh"
#include "cuda/runtime/launch.h"

namespace pl::cuda {
namespace {

template <std::uint32_t kFeatureBits>
__global__ void __launch_bounds__(kThreadsPerBlock) show_view(const __grid_constant__ ViewSetup setup) {
    const BvhIntersector intersector{setup.scene};
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

template <std::uint32_t kFeatureBits>
__global__ void __launch_bounds__(kThreadsPerBlock) refine_film(const __grid_constant__ EmissionSetup setup) {
    const BvhIntersector intersector{setup.scene};
    const std::uint32_t number = setup.range.first + thread_number();
    SingleRays<FeatureSet{kFeatureBits}, BvhIntersector> rays{setup.scene, intersector};
    PassCounters counters;
    if (number < setup.range.end)
        counters.path.emission_rays = refine_emission<FeatureSet{kFeatureBits}>(
            setup.context, setup.scene, rays, setup.film, setup.subset.pixel(number));
    add_up(*setup.counters, counters);
}

template <std::uint32_t kFeatureBits>
__global__ void __launch_bounds__(kThreadsPerBlock) mark_borders(const __grid_constant__ EmissionSetup setup) {
    const BvhIntersector intersector{setup.scene};
    const std::uint32_t light = thread_number();
    SingleRays<FeatureSet{kFeatureBits}, BvhIntersector> rays{setup.scene, intersector};
    PassCounters counters;
    if (light < setup.scene.lights.count)
        counters.path.emission_rays =
            mark_lamp_borders<FeatureSet{kFeatureBits}>(setup.context, setup.scene, rays, setup.film, light);
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
