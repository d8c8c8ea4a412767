// Whether the CUDA back end can be used, and on what.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace pl {

struct CudaDevice {
    std::string name;
    std::size_t memory_bytes = 0;
    int major = 0;  ///< compute capability
    int minor = 0;
};

/// Why CUDA cannot be used, in words; empty if it can. Costs under a millisecond without a driver.
std::string cuda_unavailable_reason();

/// All devices that the driver shows; empty if there are none.
std::vector<CudaDevice> cuda_devices();

}  // namespace pl
