// Owners of memory on the device and of host memory that the device copies to by itself.
#pragma once

#include <cstddef>
#include <utility>

#include "cuda/runtime/stream.h"

namespace pl::cuda {

/// Memory on the device. Plain allocations: managed memory would hide copies and can hang a card that is full.
struct DeviceHeap {
    static void* allocate(std::size_t bytes);
    static void release(void* data) noexcept;
};

/// Host memory that stays where it is, so that copies run beside everything else.
struct PinnedHeap {
    static void* allocate(std::size_t bytes);
    static void release(void* data) noexcept;
};

/// Bytes of a heap, by its only owner.
template <class Heap>
class OwnedMemory {
public:
    OwnedMemory() = default;
    /// Not cleared. Throws Error(Unavailable) with the size if there is no room.
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

/// Queue a copy or a clearing. Both memories have to live, and the source to stay unchanged, until it is done.
void copy_to_device(void* device, const void* host, std::size_t bytes, const Stream& stream);
void copy_to_host(void* host, const void* device, std::size_t bytes, const Stream& stream);
void clear(void* device, std::size_t bytes, const Stream& stream);

}  // namespace pl::cuda
