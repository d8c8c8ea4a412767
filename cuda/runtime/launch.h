// Kernel launches with checked argument types. Uses cudaLaunchKernel, so that host code which launches kernels needs
// no device compiler.
#pragma once

#include <algorithm>
#include <tuple>

#include "cuda/runtime/stream.h"

namespace pl::cuda {

inline constexpr std::uint32_t kThreadsPerBlock = 128;

struct LaunchShape {
    std::uint32_t blocks = 0;
    std::uint32_t threads = kThreadsPerBlock;  ///< per block
};

/// Queues a launch. Arguments convert to the kernel's parameter types.
template <class... Parameters, class... Arguments>
void launch(void (*kernel)(Parameters...), LaunchShape shape, const Stream& stream, const char* name,
            Arguments&&... arguments) {
    if (shape.blocks == 0) return;
    std::tuple<std::remove_const_t<Parameters>...> values{std::forward<Arguments>(arguments)...};
    std::apply(
        [&](auto&... value) {
            void* pointers[] = {static_cast<void*>(&value)...};
            check(cudaLaunchKernel(kernel, dim3(shape.blocks), dim3(shape.threads), pointers, 0, stream.handle()),
                  std::string("launching ") + name);
        },
        values);
}

/// Number of blocks for one thread per item.
inline std::uint32_t blocks_of(std::uint32_t threads, std::uint32_t count) {
    return static_cast<std::uint32_t>((std::uint64_t{count} + threads - 1) / threads);
}
inline LaunchShape one_thread_each(std::uint32_t count) { return {blocks_of(kThreadsPerBlock, count)}; }

inline int processors_of_device() {
    int count = 0;
    check(cudaDeviceGetAttribute(&count, cudaDevAttrMultiProcessorCount, 0), "asking for the number of processors");
    return count;
}

/// For kernels with persistent threads: as many blocks as fill the device, but no more than `count` threads need, of as many threads
/// as the kernel was compiled for.
template <class... Parameters>
LaunchShape resident_threads(void (*kernel)(Parameters...), int processors, std::uint32_t count) {
    cudaFuncAttributes attributes{};
    check(cudaFuncGetAttributes(&attributes, reinterpret_cast<const void*>(kernel)),
          "asking for a kernel's block size");
    int blocks = 0;
    check(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&blocks, kernel, attributes.maxThreadsPerBlock, 0),
          "asking for a kernel's occupancy");
    const auto threads = static_cast<std::uint32_t>(attributes.maxThreadsPerBlock);
    const std::uint32_t resident =
        static_cast<std::uint32_t>(std::max(blocks, 1)) * static_cast<std::uint32_t>(processors);
    return {std::min(resident, blocks_of(threads, count)), threads};
}

}  // namespace pl::cuda
