// DeviceArray: the array type of Storage<Array> templates on a device.
#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "core/base/host_array.h"
#include "cuda/runtime/memory.h"

namespace pl::cuda {

/// A fixed-size array in device memory. Kernels access it through view_of().
template <class T>
class DeviceArray {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    DeviceArray() = default;
    /// Uninitialized.
    explicit DeviceArray(std::size_t count) : memory_(count * sizeof(T)), count_(count) {}

    T* data() const { return static_cast<T*>(memory_.data()); }
    std::size_t size() const { return count_; }
    std::size_t bytes() const { return count_ * sizeof(T); }

    /// Queued; `values` must stay alive until the host has synchronized with the stream.
    template <class Allocator>
    void upload(const std::vector<T, Allocator>& values, const Stream& stream) {
        if (values.size() != count_) *this = DeviceArray(values.size());
        copy_to_device(data(), values.data(), bytes(), stream);
    }
    /// Queued; `values` is complete once the host has synchronized with the stream.
    template <class Allocator>
    void download(std::vector<T, Allocator>& values, const Stream& stream) const {
        values.resize(count_);
        copy_to_host(values.data(), data(), bytes(), stream);
    }
    void clear(const Stream& stream) { cuda::clear(data(), bytes(), stream); }

private:
    DeviceMemory memory_;
    std::size_t count_ = 0;
};

template <class T>
Span<const T> view_of(const DeviceArray<T>& array) {
    return {array.data(), static_cast<std::uint32_t>(array.size())};
}
template <class T>
Span<T> view_of(DeviceArray<T>& array) {
    return {array.data(), static_cast<std::uint32_t>(array.size())};
}

}  // namespace pl::cuda
