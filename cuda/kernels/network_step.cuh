// The step of a segment in which the threads of a warp evaluate the network of a ThreadNeuralField together, for the
// threads that have reached a vertex.
#pragma once

#include <bit>

#include "core/kernel/guiding/network_tile.h"
#include "cuda/kernels/lane.cuh"
#include "cuda/kernels/thread_mixtures.h"

namespace pl::cuda {

inline constexpr std::uint32_t kWarps = kThreadsPerBlock / kWarpLanes;

/// Vertices that a warp evaluates at once, whose units fit shared memory beside the mixtures and the leaves of a small scene. More share
/// a weight that is loaded.
constexpr std::uint32_t vertices_of_warp() {
    constexpr std::uint32_t kMostBytes = 48 * 1024 - kThreadsPerBlock * sizeof(VertexMixture) - 6 * 1024;
    if (kWarpLanes == 1) return 1;
    std::uint32_t vertices = 16;
    while (kWarps * kHiddenUnits * (vertices + 4) * sizeof(float) > kMostBytes) vertices /= 2;
    return vertices;
}
using WarpTile = NetworkTile<kWarpLanes, vertices_of_warp()>;

/// The memory of the tile of this warp.
__device__ inline float* tile_memory() {
#ifdef __CUDA_ARCH__
    __shared__ alignas(16) float memory[kWarps * WarpTile::kMemory];
    return memory + threadIdx.x / kWarpLanes * WarpTile::kMemory;
#else
    static thread_local float memory[WarpTile::kMemory];
    return memory;
#endif
}

/// Sets the mixture of this thread, whose path has reached a vertex if `is_vertex`. All threads of a block must call it.
__device__ inline void evaluate_network(const NetworkField& field, bool is_vertex, const SurfacePoint& surface) {
    VertexMixture& mixture = MixturesOfThreads::of({});
    const Vec3f normal = surface.shading_normal;
    if (field.is_lost()) {
        if (is_vertex) set_cosine(mixture, normal);
        return;
    }
    const WarpTile tile(tile_memory(), lane_number());
    float inputs[kInputs];
    if (is_vertex) fill_inputs(field.point_of(surface.position, normal), field.weights.data, inputs);
    const std::uint32_t vertices = lanes_where(is_vertex);
    const std::uint32_t number = lanes_before(vertices);
    LobesOf<kVertexLobes, kVertexLobes>& outputs = mixture.lobes;
    for (std::uint32_t first = 0; first < static_cast<std::uint32_t>(std::popcount(vertices));
         first += WarpTile::kVertices) {
        const std::uint32_t vertex = number - first;  // of the tile; large for vertices before the first
        const bool is_here = is_vertex && vertex < WarpTile::kVertices;
        if (is_here) tile.set_inputs(vertex, inputs);
        tile.evaluate(field.weights.data, [] { wait_for_lanes(); });
        for (std::uint32_t i = 0; is_here && i < kVertexLobes; ++i) {
            const LobeOutputs of_lobe = outputs_by([&](std::uint32_t n) { return tile.output(vertex, n); }, i);
            outputs.set(i, {of_lobe.shift, of_lobe.narrowness}, of_lobe.logit);
        }
        wait_for_lanes();
    }
    const auto output = [&](std::uint32_t i) -> LobeOutputs {
        const VmfLobe shift = outputs.lobe(i);
        return {outputs.weight[i], shift.mean, shift.kappa};
    };
    if (is_vertex) set_mixture_by(mixture, output, normal);
}

}  // namespace pl::cuda
