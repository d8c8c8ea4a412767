// Owners of device memory and of pinned host memory.
#pragma once

#include <cstddef>
#include <utility>

#include "cuda/runtime/stream.h"

namespace pl::cuda {

/// Device memory. Not managed memory, which hides copies and can hang a device whose memory is exhausted.
struct DeviceHeap {
    static void* allocate(std::size_t bytes);
    static void release(void* data) noexcept;
};

/// Pinned (page-locked) host memory, so that copies run concurrently with kernels and the host.
struct PinnedHeap {
    static void* allocate(std::size_t bytes);
    static void release(void* data) noexcept;
};

/// Unique owner of an allocation from a heap.
template <class Heap>
class OwnedMemory {
public:
    OwnedMemory() = default;
    /// Uninitialized. Throws Error(Unavailable), with the size, if the allocation fails.
    explicit OwnedMemory(std::size_t bytes) : data_(bytes > 0 ? Heap::allocate(bytes) : nullptr), bytes_(bytes) {}
    ~OwnedMemory() {
        if (data_ != nullptr) Heap::release(data_);
    }
    OwnedMemory(OwnedMemory&& other) noexcept
        : data_(std::exchange(other.data_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}
    OwnedMemory& operator=(OwnedMemory&& other) noexcept {
        std::swap(data_, other.data_);
        std::swap(bytes_, other.bytes_);
        return *this;
    }

    void* data() const { return data_; }
    std::size_t bytes() const { return bytes_; }

private:
    void* data_ = nullptr;
    std::size_t bytes_ = 0;
};

using DeviceMemory = OwnedMemory<DeviceHeap>;
using PinnedMemory = OwnedMemory<PinnedHeap>;

/// Queue a copy or a clear. Both allocations must stay alive, and the source unchanged, until it completes.
void copy_to_device(void* device, const void* host, std::size_t bytes, const Stream& stream);
void copy_to_host(void* host, const void* device, std::size_t bytes, const Stream& stream);
void clear(void* device, std::size_t bytes, const Stream& stream);

}  // namespace pl::cuda
