// Kernel launches with checked argument types. Uses cudaLaunchKernel, so that host code which launches kernels needs
// no device compiler.
#pragma once

#include <tuple>

#include "cuda/runtime/stream.h"

namespace pl::cuda {

inline constexpr std::uint32_t kThreadsPerBlock = 128;

/// Queues a launch of `blocks` blocks of kThreadsPerBlock threads. Arguments convert to the kernel's parameter types.
template <class... Parameters, class... Arguments>
void launch(void (*kernel)(Parameters...), std::uint32_t blocks, const Stream& stream, const char* name,
            Arguments&&... arguments) {
    if (blocks == 0) return;
    std::tuple<std::remove_const_t<Parameters>...> values{std::forward<Arguments>(arguments)...};
    std::apply(
        [&](auto&... value) {
            void* pointers[] = {static_cast<void*>(&value)...};
            check(cudaLaunchKernel(kernel, dim3(blocks), dim3(kThreadsPerBlock), pointers, 0, stream.handle()),
                  std::string("launching ") + name);
        },
        values);
}

/// Number of blocks for one thread per item.
inline std::uint32_t blocks_for(std::uint32_t count) {
    return static_cast<std::uint32_t>((std::uint64_t{count} + kThreadsPerBlock - 1) / kThreadsPerBlock);
}

inline int processors_of_device() {
    int count = 0;
    check(cudaDeviceGetAttribute(&count, cudaDevAttrMultiProcessorCount, 0), "asking for the number of processors");
    return count;
}

/// Number of blocks that fill the device, for kernels with persistent threads.
template <class... Parameters>
std::uint32_t resident_blocks(void (*kernel)(Parameters...), int processors) {
    int blocks = 0;
    check(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&blocks, kernel, static_cast<int>(kThreadsPerBlock), 0),
          "asking for a kernel's occupancy");
    return static_cast<std::uint32_t>(blocks < 1 ? 1 : blocks) * static_cast<std::uint32_t>(processors);
}

}  // namespace pl::cuda
