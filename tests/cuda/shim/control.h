// Controls of the simulated CUDA runtime.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "tests/cuda/shim/cuda_runtime.h"

namespace pl::shim {

/// Resets to one working device, one host thread per launch, no failures.
void reset();

/// Sets the devices the driver reports; `code` is the result of cudaGetDeviceCount.
void set_devices(int count, cudaError_t code = cudaSuccess);
/// Sets whether the build has code for the device.
void set_code_fits(bool fits);

/// Sets the number of host threads that run the threads of a launch.
void set_threads(int threads);

/// Makes the call with this name ("cudaMalloc", "cudaLaunchKernel", ...) fail after `successes` further successful
/// calls. After a lasting failure every later call fails, too, as after an error in a kernel.
void fail(const std::string& call, cudaError_t code, int successes = 0, bool lasting = false);

/// Called around every launch, copy and clear, when it is queued. `kernel` is null for copies and clears, `bytes` 0 for launches.
using Observer = std::function<void(const void* kernel, std::size_t bytes, Queue* stream)>;
/// Sets the observers until the next reset; empty ones end them.
void observe(Observer before, Observer after);

/// Number of objects not yet released.
std::size_t device_bytes();
int live_objects();  ///< streams, events, allocations
/// Number of kernel launches since the last reset.
int launches();
/// Flags of the device, and whether a call has created its context.
unsigned device_flags();
bool has_context();

}  // namespace pl::shim
