// The main loop on a device. Threads are persistent: one that finishes a path starts the next of the range while the
// other threads of its warp continue theirs, so that long paths do not leave a warp idle ("regeneration"). A thread that has traced
// as many segments as a launch may parks its path, see PathLauncher.
// [Novak et al. 2010, "Path Regeneration for Interactive Path Tracing"]
#pragma once

#include <cstring>

#include "core/kernel/integrator/trace_path.h"
#include "cuda/kernels/kernels.h"
#include "cuda/kernels/lane.cuh"
#include "cuda/kernels/network_step.cuh"
#include "cuda/kernels/scene_intersector.cuh"
#include "cuda/runtime/launch.h"

namespace pl::cuda {

template <FeatureSet F, class M>
__device__ inline PathState<F, M> begin(const PixelPaths& paths, const PathSettings& settings, std::uint32_t number) {
    const std::uint32_t pass = number / paths.per_pass;
    const std::uint32_t pixel = number - pass * paths.per_pass;
    const PixelGrid grid{paths.grid.width, paths.grid.height, paths.grid.sample + pass};
    return begin_path<F, M>(paths.camera, grid, pixel, pixel_start(settings, pixel, grid.sample));
}
template <FeatureSet F, class M>
__device__ inline PathState<F, M> begin(const ProbePaths& paths, const PathSettings& settings, std::uint32_t probe) {
    return begin_probe<F>(paths.field, settings, probe, paths.stratum);
}

template <FeatureSet F, class M>
__device__ inline void finish(const PixelPaths& paths, const PathState<F, M>& state, MethodCounters&) {
    const std::uint32_t pass = state.sample - paths.grid.sample;
    paths.radiance[pass * paths.per_pass + state.pixel - paths.first] = state.radiance;
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

/// Where this thread leaves its path. Copied as bytes: nvcc 13 copies twice the size of a state with empty members, when it copies
/// them one by one.
template <FeatureSet F, class M>
__device__ inline void* parking_place(const Parking& parking) {
    using State = PathState<F, M>;
    std::byte* place = static_cast<std::byte*>(parking.states) + std::size_t{thread_number()} * sizeof(State);
    return __builtin_assume_aligned(place, alignof(State));
}

/// The path that this thread left in the last launch, if there may be one, or else the next of the range. Returns false if there
/// is none.
template <FeatureSet F, class M, class Paths>
__device__ inline bool next_path(const TraceSetup& setup, const Paths& paths, bool resumes, PathState<F, M>& state) {
    if (resumes && setup.parking.is_waiting[thread_number()] != 0)
        std::memcpy(static_cast<void*>(&state), parking_place<F, M>(setup.parking), sizeof state);
    else if (!start(setup, paths, state))
        return false;
    // Of a resumed path, too: the compiler then knows that it is global memory.
    keep_store(state, static_cast<typename M::Store*>(setup.stores) + thread_number());
    return true;
}

/// Leaves the path of this thread, if it has one, to the next launch.
template <FeatureSet F, class M>
__device__ inline void park(const Parking& parking, const PathState<F, M>& state, bool active) {
    if (parking.states == nullptr) return;
    parking.is_waiting[thread_number()] = active ? 1 : 0;
    if (active) std::memcpy(parking_place<F, M>(parking), static_cast<const void*>(&state), sizeof state);
}

/// The counts of one thread in a launch, which ends long before 32 bits do. 64 bits would take twice the registers.
using ThreadCounters = PassCountersOf<std::uint32_t>;

__device__ inline void add_to(ThreadCounters& totals, const PassCounters& counters) {
    add_counters(totals, counters,
                 [](std::uint32_t& total, std::uint64_t count) { total += static_cast<std::uint32_t>(count); });
}

/// The set of features as bits, since the launch stubs of nvcc cannot name a FeatureSet.
template <std::uint32_t kFeatureBits, Method M, class Paths>
__global__ void __launch_bounds__(trace_block<FeatureSet{kFeatureBits}, M>().threads,
                                  trace_block<FeatureSet{kFeatureBits}, M>().resident)
    trace_paths(const __grid_constant__ TraceSetup setup, const __grid_constant__ M method,
                const __grid_constant__ Paths paths) {
    constexpr FeatureSet kFeatures{kFeatureBits};
    using Step = StepOfBlock<trace_block<kFeatures, M>().steps>;
    const SceneIntersector<kFeatures> intersector{setup.scene};
    const PathContext<M> context{setup.scene, method, setup.path};
    ThreadCounters counters;
    PathState<kFeatures, M> state;
    keep_store(state, static_cast<typename M::Store*>(setup.stores) + thread_number());
    PathStatus status = PathStatus::Finished;
    bool resumes = setup.parking.resumes != 0;
    bool has_path = true;
    while (true) {
        has_path = has_path && counters.path.segments < setup.parking.most_segments &&
                   (status == PathStatus::Continues || next_path(setup, paths, resumes, state));
        if (!Step::any(has_path)) break;
        resumes = false;
        Hit hit;
        if (has_path) hit = closest_solid_hit<kFeatures>(setup.scene, intersector, state.ray);
        Step::template begin<2>();
        PassCounters fresh;
        SegmentEnd<kFeatures, M> end;
        if (has_path) status = shade_segment<kFeatures>(context, hit, state, end, fresh.path);
        if constexpr (NetworkMethod<M>)
            evaluate_network(method.field, has_path && status == PathStatus::Continues && end.from.vertex.is_served(),
                             end.from.surface);
        Step::template begin<5>();
        ShadowRequest<M> shadow;
        if (has_path) status = sample_light_at_end<kFeatures>(context, status, end, state, shadow, fresh.path);
        Step::template begin<4>();
        if (has_path) status = scatter_at_end<kFeatures>(context, status, end, state, fresh.path);
        Step::template begin<3>();
        if (has_path) {
            status = connect_segment<kFeatures>(context, intersector, shadow, status, state, fresh.path);
            if (status == PathStatus::Finished) {
                count_path(fresh, state.radiance, is_valid_radiance(state.radiance));
                finish(paths, state, fresh.path.method);
            }
            add_to(counters, fresh);
        }
    }
    park(setup.parking, state, status == PathStatus::Continues);
    raise_to(*setup.longest, counters.path.segments);
    add_up(*setup.counters, counters);
}

template <int kEntry>
constexpr PictureKernels<kEntry> make_picture_kernels() {
    using M = KernelMethodAt<kEntry>;
    return make_kernel_row<PictureKernel<M>, TypeAt<kEntry, MethodList>::kRange>(
        []<FeatureSet F>() { return trace_paths<F.bits, M, PixelPaths>; });
}

}  // namespace pl::cuda
