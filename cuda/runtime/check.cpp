#include "cuda/runtime/check.h"

#include <string_view>

#include <fmt/format.h>

#include "core/base/error.h"

namespace pl::cuda {

void check(cudaError_t code, const std::string& call, const std::source_location& where) {
    if (code == cudaSuccess) return;
    (void)cudaGetLastError();  // clears the error, so that no later call reports it again
    const std::string_view path = where.file_name();
    const std::string_view file = path.substr(path.rfind('/') + 1);
    throw Error(ErrorKind::Unavailable,
                fmt::format("CUDA: {} failed: {} ({}) [{}:{}]", call, cudaGetErrorString(code),
                            cudaGetErrorName(code), file, where.line()));
}

}  // namespace pl::cuda
