// The ceilings of the first device, against which kernels are judged.
#pragma once

namespace pl::parity {

struct DeviceCeiling {
    double lane_instructions_per_second = 0.0;  ///< processors x 4 schedulers x 32 lanes x nominal clock
    double bytes_per_second = 0.0;              ///< of a copy within the device's memory, read and written, measured
};

/// Throws Error(Unavailable) as CUDA does; the device must have 2 `megabytes` (of 10^6 bytes) to spare.
DeviceCeiling measure_ceiling(double megabytes);

}  // namespace pl::parity
