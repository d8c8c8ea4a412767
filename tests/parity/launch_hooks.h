// Hooks into the calls by which cuda/ queues work: around each launch and copy. On a device they wrap functions of the runtime
// (device_hooks.cpp, with the linker's --wrap), on the host stand-in they are its observers (host_hooks.cpp). Programs without hooks
// have no code for them.
#pragma once

#include <cstddef>
#include <functional>

#include <cuda_runtime.h>

namespace pl::parity {

/// A launch, or a copy or clear if there is no kernel.
struct QueuedWork {
    const void* kernel = nullptr;
    std::size_t bytes = 0;  ///< of a copy or clear
    cudaStream_t stream = nullptr;
};

struct LaunchHooks {
    std::function<void(const QueuedWork&)> before;
    std::function<void(const QueuedWork&)> after;
};

/// Replaces the hooks of this process; empty ones end them. Only while no other thread queues work.
void set_launch_hooks(LaunchHooks hooks);

}  // namespace pl::parity
