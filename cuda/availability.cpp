#include "cuda/availability.h"

#include <cuda_runtime.h>
#include <fmt/format.h>

#include "core/base/error.h"
#include "cuda/kernels/kernels.h"
#include "cuda/runtime/check.h"

namespace pl {
namespace {

/// Sets the number of devices; returns the error if the driver reports none.
cudaError_t count_devices(int& count) {
    count = 0;  // cudaGetDeviceCount does not set it on failure
    const cudaError_t code = cudaGetDeviceCount(&count);
    (void)cudaGetLastError();
    return code;
}

}  // namespace

std::string cuda_unavailable_reason() {
    int count = 0;
    const cudaError_t code = count_devices(count);
    if (code == cudaErrorInsufficientDriver) return "no NVIDIA driver, or one older than this build's CUDA";
    if (code == cudaErrorNoDevice || (code == cudaSuccess && count == 0)) return "the driver shows no device";
    if (code != cudaSuccess) return fmt::format("{} ({})", cudaGetErrorString(code), cudaGetErrorName(code));
    return "";
}

std::vector<CudaDevice> cuda_devices() {
    int count = 0;
    if (count_devices(count) != cudaSuccess) return {};
    std::vector<CudaDevice> devices;
    for (int i = 0; i < count; ++i) {
        cudaDeviceProp properties;
        cuda::check(cudaGetDeviceProperties(&properties, i), "asking for a device's properties");
        devices.push_back({properties.name, properties.totalGlobalMem, properties.major, properties.minor});
    }
    return devices;
}

}  // namespace pl

namespace pl::cuda {

void open_device() {
    check(cudaSetDeviceFlags(cudaDeviceScheduleBlockingSync), "choosing how to wait for the device");
    cudaFuncAttributes attributes;
    const cudaError_t code = cudaFuncGetAttributes(&attributes, reinterpret_cast<const void*>(kAddSamples));
    if (code == cudaErrorNoKernelImageForDevice || code == cudaErrorInvalidDeviceFunction) {
        (void)cudaGetLastError();
        throw Error(ErrorKind::Unavailable, fmt::format("CUDA: this build has no code for the first device: {} ({})",
                                                        cudaGetErrorString(code), cudaGetErrorName(code)));
    }
    check(code, "creating a context");
}

}  // namespace pl::cuda
