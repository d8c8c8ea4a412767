// Owners of memory on the device and of host memory that the device copies to by itself.
#pragma once

#include <cstddef>

#include "cuda/runtime/stream.h"

namespace pl::cuda {

/// Bytes on the device. Plain allocations: managed memory would hide copies and can hang a card that is full.
class DeviceMemory {
public:
    DeviceMemory() = default;
    /// Not cleared. Throws Error(Unavailable) with the size if the device has no room.
    explicit DeviceMemory(std::size_t bytes);
    ~DeviceMemory();
    DeviceMemory(DeviceMemory&& other) noexcept;
    DeviceMemory& operator=(DeviceMemory&& other) noexcept;

    void* data() const { return data_; }
    std::size_t bytes() const { return bytes_; }

private:
    void* data_ = nullptr;
    std::size_t bytes_ = 0;
};

/// Host memory that stays where it is, so that copies run beside everything else.
class PinnedMemory {
public:
    PinnedMemory() = default;
    explicit PinnedMemory(std::size_t bytes);
    ~PinnedMemory();
    PinnedMemory(PinnedMemory&& other) noexcept;
    PinnedMemory& operator=(PinnedMemory&& other) noexcept;

    void* data() const { return data_; }
    std::size_t bytes() const { return bytes_; }

private:
    void* data_ = nullptr;
    std::size_t bytes_ = 0;
};

/// Queue a copy or a clearing. Both memories have to live, and the source to stay unchanged, until it is done.
void copy_to_device(void* device, const void* host, std::size_t bytes, const Stream& stream);
void copy_to_host(void* host, const void* device, std::size_t bytes, const Stream& stream);
void clear(void* device, std::size_t bytes, const Stream& stream);

}  // namespace pl::cuda
