// Replaces the CUDA back end in builds without a CUDA compiler.
#include "core/base/error.h"
#include "cuda/availability.h"
#include "cuda/cuda_backend.h"

namespace pl {

std::string cuda_unavailable_reason() { return std::string("not built: ") + PL_CUDA_MISSING; }

std::vector<CudaDevice> cuda_devices() { return {}; }

std::unique_ptr<RenderBackend> make_cuda_backend(const CudaOptions&) {
    throw Error(ErrorKind::Unavailable, "CUDA: " + cuda_unavailable_reason());
}

}  // namespace pl
