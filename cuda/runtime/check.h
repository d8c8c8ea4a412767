// Turns errors of the CUDA runtime into exceptions that name the call, the source line and the cause.
#pragma once

#include <source_location>
#include <string>

#include <cuda_runtime.h>

namespace pl::cuda {

/// Throws Error(Unavailable) with call, source line and cause unless `code` is cudaSuccess. An error in a kernel is
/// reported by a later call; the device is then lost for this process, which the message says, and every further call fails, too.
void check(cudaError_t code, const std::string& call,
           const std::source_location& where = std::source_location::current());

}  // namespace pl::cuda
