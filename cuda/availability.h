// Availability of the CUDA back end, and the devices it can use.
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

/// Reason why CUDA is unavailable, as a message; empty if it is available. Takes less than 1 ms without a driver.
std::string cuda_unavailable_reason();

/// All devices the driver reports; may be empty.
std::vector<CudaDevice> cuda_devices();

}  // namespace pl
