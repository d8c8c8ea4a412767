#include "cuda/runtime/check.h"

#include <string_view>

#include <fmt/format.h>

#include "core/base/error.h"

namespace pl::cuda {
namespace {

/// Whether the error has destroyed the context: every later call of this process fails with it.
bool ends_context(cudaError_t code) {
    switch (code) {
    case cudaErrorECCUncorrectable:
    case cudaErrorNvlinkUncorrectable:
    case cudaErrorIllegalAddress:
    case cudaErrorLaunchTimeout:
    case cudaErrorContextIsDestroyed:
    case cudaErrorAssert:
    case cudaErrorHardwareStackError:
    case cudaErrorIllegalInstruction:
    case cudaErrorMisalignedAddress:
    case cudaErrorInvalidAddressSpace:
    case cudaErrorInvalidPc:
    case cudaErrorLaunchFailure: return true;
    default: return false;
    }
}

}  // namespace

void check(cudaError_t code, const std::string& call, const std::source_location& where) {
    if (code == cudaSuccess) return;
    (void)cudaGetLastError();  // clears the error, so that no later call reports it again
    const std::string_view path = where.file_name();
    const std::string_view file = path.substr(path.rfind('/') + 1);
    throw Error(ErrorKind::Unavailable,
                fmt::format("CUDA: {} failed: {} ({}) [{}:{}]{}", call, cudaGetErrorString(code),
                            cudaGetErrorName(code), file, where.line(),
                            ends_context(code) ? "; restart the program to use the GPU again" : ""));
}

}  // namespace pl::cuda
