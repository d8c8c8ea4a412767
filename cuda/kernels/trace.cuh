// The main loop on a device. Threads are persistent: one that finishes a path starts the next of the range while the
// other threads of its warp continue theirs, so that long paths do not leave a warp idle ("regeneration").
// [Novak et al. 2010, "Path Regeneration for Interactive Path Tracing"]
#pragma once

#include "core/kernel/geometry/intersector.h"
#include "core/kernel/integrator/trace_path.h"
#include "cuda/kernels/kernels.h"
#include "cuda/kernels/lane.cuh"
#include "cuda/runtime/launch.h"

namespace pl::cuda {

template <FeatureSet F, class M>
__device__ inline PathState<F, M> begin(const PixelPaths& paths, const PathSettings& settings, std::uint32_t number) {
    const Vec4f start = pixel_start(settings, number, paths.grid.sample);
    return begin_path<F, M>(paths.camera, paths.grid, paths.subset.pixel(number), start);
}
template <FeatureSet F, class M>
__device__ inline PathState<F, M> begin(const ProbePaths& paths, const PathSettings& settings, std::uint32_t probe) {
    return begin_probe<F>(paths.field, settings, probe, paths.stratum);
}

template <FeatureSet F, class M>
__device__ inline void finish(const PixelPaths& paths, const PathState<F, M>& state, MethodCounters&) {
    paths.radiance[paths.subset.number(state.pixel) - paths.first] = state.radiance;
}
template <FeatureSet F>
__device__ inline void finish(const ProbePaths& paths, const PathState<F, ProbeMethod>& state,
                              MethodCounters& counters) {
    finish_probe(paths.field, state, counters);
}

/// Claims and starts the next path of a thread. Returns false if the range is exhausted.
template <FeatureSet F, class M, class Paths>
__device__ inline bool start(const TraceSetup& setup, const Paths& paths, PathState<F, M>& state) {
    const std::uint32_t taken = claim(*setup.claimed);
    if (taken >= setup.range.end - setup.range.first) return false;
    state = begin<F, M>(paths, setup.path, setup.range.first + taken);
    return true;
}

/// The set of features as bits, since the launch stubs of nvcc cannot name a FeatureSet.
template <std::uint32_t kFeatureBits, Method M, class Paths>
__global__ void __launch_bounds__(kThreadsPerBlock)
    trace_paths(const __grid_constant__ TraceSetup setup, const __grid_constant__ M method,
                const __grid_constant__ Paths paths) {
    const BvhIntersector intersector{setup.scene};
    const PathContext<M> context{setup.scene, method, setup.path};
    PassCounters counters;
    PathState<FeatureSet{kFeatureBits}, M> state;
    bool active = start(setup, paths, state);
    while (active) {
        const PathStatus status = trace_segment<FeatureSet{kFeatureBits}>(context, intersector, state, counters.path);
        if (status == PathStatus::Continues) continue;
        count_path(counters, state.radiance, is_valid_radiance(state.radiance));
        finish(paths, state, counters.path.method);
        active = start(setup, paths, state);
    }
    add_up(*setup.counters, counters);
}

template <Method M>
constexpr KernelRow<PictureKernel<M>> make_picture_kernels() {
    return make_kernel_row<PictureKernel<M>, M::kKernelRange>(
        []<FeatureSet F>() { return trace_paths<F.bits, M, PixelPaths>; });
}

}  // namespace pl::cuda
