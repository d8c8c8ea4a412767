// The controls of the stand-in runtime.
#pragma once

#include <cstddef>
#include <string>

#include "tests/cuda/shim/cuda_runtime.h"

namespace pl::shim {

/// Back to one healthy device, one host thread per launch, nothing failing.
void reset();

/// The machine as the driver shows it; `code` is the result of counting devices.
void set_devices(int count, cudaError_t code = cudaSuccess);
/// Whether the build has code for the device.
void set_code_fits(bool fits);

/// Host threads that run a launch's threads.
void set_threads(int threads);

/// The call with this name ("cudaMalloc", "cudaLaunchKernel", ...) fails, after `successes` more calls that do not.
/// A lasting failure makes every later call fail alike, as after a kernel that crashed.
void fail(const std::string& call, cudaError_t code, int successes = 0, bool lasting = false);

/// Objects not yet released.
std::size_t device_bytes();
int live_objects();  ///< streams, events, pieces of memory
/// Kernel launches since the last reset.
int launches();

}  // namespace pl::shim
