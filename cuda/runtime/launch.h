// Starting kernels with checked arguments, through the plain interface of the runtime: host code that launches needs
// no device compiler.
#pragma once

#include <tuple>

#include "cuda/runtime/stream.h"

namespace pl::cuda {

inline constexpr std::uint32_t kThreadsPerBlock = 128;

/// Queues `blocks` blocks of kThreadsPerBlock threads. Arguments convert to the kernel's own parameter types.
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

/// Blocks that give every one of `count` items a thread.
inline std::uint32_t blocks_for(std::uint32_t count) {
    return static_cast<std::uint32_t>((std::uint64_t{count} + kThreadsPerBlock - 1) / kThreadsPerBlock);
}

/// Blocks that keep the whole device busy with threads that take work until there is none left.
template <class... Parameters>
std::uint32_t resident_blocks(void (*kernel)(Parameters...), int processors) {
    int blocks = 0;
    check(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&blocks, kernel, static_cast<int>(kThreadsPerBlock), 0),
          "asking for a kernel's occupancy");
    return static_cast<std::uint32_t>(blocks < 1 ? 1 : blocks) * static_cast<std::uint32_t>(processors);
}

}  // namespace pl::cuda
