// HostArray: the array type of Storage<Array> templates on the host. Device back ends have their own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/kernel/base/span.h"

namespace pl {

template <class T>
using HostArray = std::vector<T>;

template <class T, class Allocator>
Span<const T> view_of(const std::vector<T, Allocator>& array) {
    return {array.data(), static_cast<std::uint32_t>(array.size())};
}
template <class T, class Allocator>
Span<T> view_of(std::vector<T, Allocator>& array) {
    return {array.data(), static_cast<std::uint32_t>(array.size())};
}

// LargeArray: a HostArray for random access to data larger than the caches. Aligned to cache lines, so that rows of
// 64 bytes occupy one each, and on huge pages where the system grants them, so that reads seldom miss the TLB.

/// Memory aligned to a cache line. Throws std::bad_alloc.
void* allocate_large(std::size_t bytes);
/// Frees memory of allocate_large(); `bytes` as allocated.
void free_large(void* memory, std::size_t bytes) noexcept;

template <class T>
struct LargeAllocator {
    using value_type = T;

    LargeAllocator() = default;
    template <class U>
    LargeAllocator(const LargeAllocator<U>&) {}

    T* allocate(std::size_t count) { return static_cast<T*>(allocate_large(count * sizeof(T))); }
    void deallocate(T* memory, std::size_t count) noexcept { free_large(memory, count * sizeof(T)); }

    friend bool operator==(const LargeAllocator&, const LargeAllocator&) { return true; }
};

template <class T>
using LargeArray = std::vector<T, LargeAllocator<T>>;

}  // namespace pl
