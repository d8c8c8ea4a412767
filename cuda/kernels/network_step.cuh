// The step of a segment in which the threads of a warp evaluate the network of a NeuralVertexField together, for those of them that
// have reached a vertex.
#pragma once

#include <bit>

#include "core/kernel/guiding/network_tile.h"
#include "core/kernel/guiding/neural_vertex_field.h"
#include "cuda/kernels/lane.cuh"

namespace pl::cuda {

/// Vertices that a warp of a block evaluates at once, whose units fit shared memory beside the leaves of a small scene. More share a
/// weight that is loaded.
constexpr std::uint32_t vertices_of_warp(std::uint32_t warps) {
    constexpr std::uint32_t kMostBytes = 42 * 1024;  // of 48 kB
    if (kWarpLanes == 1) return 1;
    std::uint32_t vertices = 16;
    while (warps * kVertexHidden * (vertices + 4) * sizeof(float) > kMostBytes) vertices /= 2;
    return vertices;
}

/// The memory of the tile of this warp.
template <class Tile, std::uint32_t kWarps>
__device__ inline float* tile_memory() {
#ifdef __CUDA_ARCH__
    __shared__ alignas(16) float memory[kWarps * Tile::kMemory];
    return memory + threadIdx.x / kWarpLanes * Tile::kMemory;
#else
    static thread_local float memory[Tile::kMemory];
    return memory;
#endif
}

/// Completes the location of a vertex by its mixture, if this thread has one: `is_vertex`. All threads of a block of `kThreads` must
/// call it. `From`: a ScatterPoint.
template <std::uint32_t kThreads, class From>
__device__ inline void evaluate_network(const NeuralVertexField& field, bool is_vertex, From& from) {
    constexpr std::uint32_t kWarps = kThreads / kWarpLanes;
    constexpr std::uint32_t kVertices = vertices_of_warp(kWarps);
    using Tile = NetworkTile<kWarpLanes, kVertices>;
    const Tile tile(tile_memory<Tile, kWarps>(), lane_number());
    const SurfacePoint& surface = from.surface;
    is_vertex = is_vertex && from.vertex.is_served();
    if (field.is_lost()) {
        if (is_vertex) from.vertex.mixture = cosine_mixture(surface.shading_normal);
        return;
    }
    float inputs[kInputs], outputs[kVertexOutputs];
    if (is_vertex)
        fill_inputs(field.point_of(surface.position, surface.shading_normal), field.weights.data, inputs);
    const std::uint32_t vertices = lanes_where(is_vertex);
    const std::uint32_t number = lanes_before(vertices);
    for (std::uint32_t first = 0; first < static_cast<std::uint32_t>(std::popcount(vertices)); first += kVertices) {
        const bool is_here = is_vertex && number - first < kVertices;  // those before the first have large numbers
        if (is_here) tile.set_inputs(number - first, inputs);
        tile.evaluate(field.weights.data, [] { wait_for_lanes(); });
        if (is_here) tile.get_outputs(number - first, outputs);
        wait_for_lanes();
    }
    if (is_vertex) from.vertex.mixture = vertex_mixture(outputs, surface.shading_normal);
}

}  // namespace pl::cuda
