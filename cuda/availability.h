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

/// Reason why CUDA is unavailable, as a message; empty if there is a device. Only counts devices: whether this build has code for
/// the first one is known when a back end is made, which creates the device's context. Takes less than 1 ms without a driver.
std::string cuda_unavailable_reason();

/// All devices the driver reports; may be empty.
std::vector<CudaDevice> cuda_devices();

}  // namespace pl

namespace pl::cuda {

/// Creates the context of the first device, in which waiting threads sleep. Throws Error(Unavailable) if this build has no code
/// for the device, or if the context cannot be used.
void open_device();

}  // namespace pl::cuda
