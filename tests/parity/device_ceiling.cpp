#include "tests/parity/device_ceiling.h"

#include <algorithm>

#include "cuda/runtime/memory.h"

namespace pl::parity {
namespace {

int attribute(cudaDeviceAttr which) {
    int value = 0;
    cuda::check(cudaDeviceGetAttribute(&value, which, 0), "asking for an attribute of the device");
    return value;
}

}  // namespace

DeviceCeiling measure_ceiling(double megabytes) {
    constexpr int kLanes = 4 * 32;
    constexpr int kCopies = 10;
    const auto bytes = static_cast<std::size_t>(1.0e6 * megabytes);
    const cuda::DeviceMemory from(bytes);
    const cuda::DeviceMemory to(bytes);
    const cuda::Stream stream;
    cuda::clear(from.data(), bytes, stream);
    float shortest = 0.0f;
    for (int i = 0; i < kCopies; ++i) {
        cuda::Event start;
        cuda::Event end;
        start.record(stream);
        cuda::check(cudaMemcpyAsync(to.data(), from.data(), bytes, cudaMemcpyDeviceToDevice, stream.handle()),
                    "copying within the device");
        end.record(stream);
        end.wait("copying within the device");
        const float milliseconds = end.milliseconds_since(start);
        shortest = i == 0 ? milliseconds : std::min(shortest, milliseconds);
    }
    constexpr double kHzPerKhz = 1.0e3;
    return {.lane_instructions_per_second = static_cast<double>(attribute(cudaDevAttrMultiProcessorCount)) * kLanes *
                                            kHzPerKhz * static_cast<double>(attribute(cudaDevAttrClockRate)),
            .bytes_per_second = 2.0 * static_cast<double>(bytes) / (1.0e-3 * static_cast<double>(shortest))};
}

}  // namespace pl::parity
