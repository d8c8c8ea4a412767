// Errors of the CUDA runtime become exceptions that name the call, the place and the cause.
#pragma once

#include <source_location>
#include <string>

#include <cuda_runtime.h>

namespace pl::cuda {

/// Throws Error(Unavailable) unless `code` says success: what failed, where, and why. An error that a kernel left
/// behind shows up at a later call; the device is then lost for this process, and every further call fails alike.
void check(cudaError_t code, const std::string& call,
           const std::source_location& where = std::source_location::current());

}  // namespace pl::cuda
